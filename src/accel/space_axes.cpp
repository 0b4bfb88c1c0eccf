#include "accel/space_axes.h"

#include "csg/enclosures.h"
#include "csg/minimum_enclosure.h"
#include "primitive/dispatch.h"

namespace tenon {

SpaceAxes SpaceAxes::eye(const ScreenView& view) {
  SpaceAxes axes;
  const Vec3 rows[] = {view.right, view.up, view.forward};
  for (std::size_t i = 0; i < 3; ++i) axes.axes_from_world_.m[i] = {rows[i].x, rows[i].y, rows[i].z, 0};
  axes.turned_ = true;
  return axes;
}

ScreenView SpaceAxes::from_world(ScreenView view) const {
  for (Vec3* v : {&view.eye, &view.right, &view.up, &view.forward}) *v = from_world(*v);
  return view;
}

Box3 SpaceAxes::bounds_of(const CsgTree& tree, LeafId id) const {
  const Leaf& leaf = tree[id];
  if (!leaf.bounds.is_bounded()) return Box3::everything();
  if (!turned_) return leaf.bounds;
  const Affine3& world_from_local = leaf.placement.world_from_local();
  Box3 box;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 normal = axes_from_world_.row(axis);
    const Vec3 local_normal = world_from_local.transposed_direction(normal);
    const double center = dot(normal, world_from_local.translation());
    box.upper[axis] = center + support(tree.primitives, leaf.primitive, local_normal);
    box.lower[axis] = center - support(tree.primitives, leaf.primitive, local_normal * -1.0);
  }
  return box;
}

std::vector<Box3> SpaceAxes::minimum_enclosures_of(const CsgTree& tree) const {
  std::vector<Box3> whole(tree.leaves.size());
  for (std::size_t i = 0; i < whole.size(); ++i) whole[i] = bounds_of(tree, LeafId{i});
  std::vector<Box3> boxes = minimum_enclosures(tree, node_enclosures(tree, whole));
  const double margin = enclosure_margin(tree);
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    // What is bounded only by its neighbours in the tree is still a leaf that no structure holds.
    boxes[i] = whole[i].is_bounded() ? grown(boxes[i], margin) : Box3::everything();
  }
  return boxes;
}

}  // namespace tenon
