#include "accel/cells/wide_node.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "accel/cells/subdivision.h"

namespace tenon::cells {

namespace {

// Rounded outward by the slack, which exceeds what the conversion rounds.
float to_float(double value) {
  return static_cast<float>(value);
}

// In which order rays of each octant meet the children of a node while these are opened one by one.
class MeetingOrder {
 public:
  // Child `low` is opened; its part on the upper side of a plane across the axis becomes the next child.
  void open(std::size_t low, int axis) {
    for (std::size_t octant = 0; octant < by_octant_.size(); ++octant) {
      Lanes& lanes = by_octant_[octant];
      const auto end = lanes.begin() + count_;
      const bool backward = (octant >> axis & 1) != 0;
      const auto place = std::find(lanes.begin(), end, low) + (backward ? 0 : 1);
      std::copy_backward(place, end, end + 1);
      *place = static_cast<std::uint8_t>(count_);
    }
    ++count_;
  }

  std::array<std::uint32_t, 8> last_to_first() const {
    std::array<std::uint32_t, 8> result{};
    for (std::size_t octant = 0; octant < by_octant_.size(); ++octant) {
      Lanes lanes = by_octant_[octant];
      std::iota(lanes.begin() + count_, lanes.end(), static_cast<std::uint8_t>(count_));
      for (const std::uint8_t lane : lanes) result[octant] = result[octant] << 3 | lane;
    }
    return result;
  }

 private:
  using Lanes = std::array<std::uint8_t, node_width>;
  std::array<Lanes, 8> by_octant_{};
  std::ptrdiff_t count_ = 1;
};

// Of a plane that lies between the boxes.
int separating_axis(const Box3& low, const Box3& high) {
  int axis = 0;
  while (axis < 3 && !(low.upper[axis] <= high.lower[axis])) ++axis;
  assert(axis < 3);
  return axis;
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
             std::size_t root_slot, HugePageVector<WideNode>& nodes) {
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
    MeetingOrder order;
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
      order.open(largest, separating_axis(binary[opened.left].box, binary[opened.right].box));
      children[largest] = opened.left;
      children.push_back(opened.right);
    }
    nodes[next.to].last_to_first = order.last_to_first();
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
