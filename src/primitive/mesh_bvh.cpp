#include "primitive/mesh_bvh.h"

#include <algorithm>
#include <cmath>

#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// What the difference of two doubles rounds by, and room for taking it off.
double outward(double value) {
  return 0x1p-52 * std::fabs(value);
}

}  // namespace

Box3 MeshBvh::Frame::box_from_outside(const Box3& box) const {
  Box3 inner{scale * (box.lower - center), scale * (box.upper - center)};
  for (int axis = 0; axis < 3; ++axis) {
    inner.lower[axis] -= outward(inner.lower[axis]);
    inner.upper[axis] += outward(inner.upper[axis]);
  }
  return inner;
}

Box3 MeshBvh::Frame::box_to_outside(const Box3& box) const {
  Box3 outer{center + (1 / scale) * box.lower, center + (1 / scale) * box.upper};
  for (int axis = 0; axis < 3; ++axis) {
    outer.lower[axis] -= outward(outer.lower[axis]);
    outer.upper[axis] += outward(outer.upper[axis]);
  }
  return outer;
}

double MeshBvh::support(const TriangleMesh& mesh, const Vec3& n) const {
  // The largest over a box, the nearest first; what a box cannot better is passed over.
  double best = -Box3::inf;
  const auto over_box = [&n](const Box3& box) {
    const Vec3 low = n * box.lower, high = n * box.upper;
    const double largest = std::max(low.x, high.x) + std::max(low.y, high.y) + std::max(low.z, high.z);
    return std::isnan(largest) ? Box3::inf : largest + gamma(4) * dot(abs(n), max(abs(box.lower), abs(box.upper)));
  };
  struct Entry {
    std::uint32_t node;
    double bound;
  };
  std::array<Entry, stack_size> stack;
  std::size_t top = 0;
  if (!nodes_.empty()) stack[top++] = {0, Box3::inf};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (!(entry.bound > best)) continue;
    const Node& node = nodes_[entry.node];
    const std::size_t first = top;
    for (std::size_t i = 0; i < width; ++i) {
      const Child child = node.children[i];
      if (child.is_none()) continue;
      const double bound = over_box(frame_.box_to_outside(box_of(node, i)));
      if (!(bound > best)) continue;
      if (!child.is_leaf()) {
        stack[top++] = {child.index(), bound};
        continue;
      }
      for (const std::uint32_t triangle : leaf(child.index())) {
        if (triangle == none) continue;
        for (const Vec3& p : mesh.corners(triangle)) best = std::max(best, dot(n, p));
      }
    }
    std::sort(stack.begin() + static_cast<std::ptrdiff_t>(first), stack.begin() + static_cast<std::ptrdiff_t>(top),
              [](const Entry& a, const Entry& b) { return a.bound < b.bound; });
  }
  return best;
}

}  // namespace tenon
