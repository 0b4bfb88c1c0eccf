#include "accel/cells/wide_node.h"

#include <algorithm>
#include <limits>

#include "accel/cells/subdivision.h"

namespace tenon::cells {

namespace {

// Rounded outward by the slack, which exceeds what the conversion rounds.
float to_float(double value) {
  return static_cast<float>(value);
}

}  // namespace

WideNode::WideNode() {
  constexpr float inf = std::numeric_limits<float>::infinity();
  for (auto& axis : ends) {
    axis[0].fill(inf);
    axis[1].fill(-inf);
  }
}

void WideNode::set_child(std::size_t lane, const Box3& box, ChildRef child) {
  children[lane] = child;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    ends[a][0][lane] = to_float(box.lower[axis]);
    ends[a][1][lane] = to_float(box.upper[axis]);
  }
}

int collapse(std::span<const SubdivisionNode> binary, std::uint32_t root, const Vec3& center, double slack,
             std::size_t root_slot, std::vector<WideNode>& nodes) {
  struct Pending {
    std::uint32_t from;
    std::size_t to;
    int depth;
  };
  int depth = 0;
  std::vector<Pending> pending{{root, root_slot, 1}};
  std::vector<std::uint32_t> children;
  while (!pending.empty()) {
    const Pending next = pending.back();
    pending.pop_back();
    depth = std::max(depth, next.depth);
    // Opens the largest of the children until there are eight.
    children.assign(1, next.from);
    while (children.size() < node_width) {
      std::size_t largest = children.size();
      double area = -1;
      for (std::size_t i = 0; i < children.size(); ++i) {
        const SubdivisionNode& child = binary[children[i]];
        if (!child.is_split() || child.box.surface_area() <= area) continue;
        area = child.box.surface_area();
        largest = i;
      }
      if (largest == children.size()) break;
      const SubdivisionNode& opened = binary[children[largest]];
      children[largest] = opened.left;
      children.push_back(opened.right);
    }
    for (std::size_t i = 0; i < children.size(); ++i) {
      const SubdivisionNode& child = binary[children[i]];
      ChildRef ref = child.leaf;
      if (child.is_split()) {
        ref = ChildRef::node(nodes.size());
        pending.push_back({children[i], nodes.size(), next.depth + 1});
        nodes.emplace_back();
      }
      nodes[next.to].set_child(i, grown(Box3{child.box.lower - center, child.box.upper - center}, slack), ref);
    }
  }
  return depth;
}

}  // namespace tenon::cells
