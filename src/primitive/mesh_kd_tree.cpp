#include "primitive/mesh_kd_tree.h"

namespace tenon {

MeshKdTree::MeshKdTree(const TriangleMesh& mesh) {
  std::vector<KdItem> items;
  items.reserve(mesh.triangles.size());
  double largest = 0;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    const auto [a, b, c] = mesh.corners(t);
    items.push_back({t, {min(a, min(b, c)), max(a, max(b, c))}, 1});
    largest = std::max(largest, max_component(max(abs(items.back().box.lower), abs(items.back().box.upper))));
  }
  // As wide as the rounding of the planes, which are floats: 2^-22 of the largest coordinate.
  margin_ = 0x1p-22 * largest;
  for (KdItem& item : items) item.box = grown(item.box, margin_);
  KdOptions options;
  options.split = KdSplit::msah;
  tree_ = build_kd_tree(items, options);
}

// The part of the line beside the mesh.
Box3 MeshKdTree::box_around(const MeshLine& line) const {
  const double reach = 2 * line.farthest;
  const Vec3 a = line.origin - reach * line.direction, b = line.origin + reach * line.direction;
  Box3 box{min(a, b) - line.growth, max(a, b) + line.growth};
  // What is not known reaches everywhere.
  for (int axis = 0; axis < 3; ++axis) {
    if (std::isnan(box.lower[axis])) box.lower[axis] = -Box3::inf;
    if (std::isnan(box.upper[axis])) box.upper[axis] = Box3::inf;
  }
  return box;
}

}  // namespace tenon
