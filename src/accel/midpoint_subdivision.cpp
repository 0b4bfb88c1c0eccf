#include "accel/midpoint_subdivision.h"

#include <algorithm>

namespace tenon {

namespace {

constexpr CellIndex counts(const Levels& levels) {
  return {1u << levels[0], 1u << levels[1], 1u << levels[2]};
}

// A box still to be looked at, and the axis its next halving should take.
struct Pending {
  MidpointBox box;
  int axis;
};

// What a box counts for, in SubdivisionLimits::held.
std::size_t weight(const MidpointBox& box) {
  return 1 + box.primitives;
}

// The first axis, from `axis` on, along which the box may still be halved; -1 when there is none.
int next_axis(const MidpointBox& box, int axis, const Levels& limit) {
  for (int i = 0; i < 3; ++i) {
    const int a = (axis + i) % 3;
    if (box.level[static_cast<std::size_t>(a)] < limit[static_cast<std::size_t>(a)]) return a;
  }
  return -1;
}

// The sub-box that contains the point C of smallest coordinates has twice the address, the other one more (§3.3).
MidpointBox half(const MidpointBox& box, int axis, std::uint32_t side) {
  const auto a = static_cast<std::size_t>(axis);
  MidpointBox child{box.address, box.level, {}, 0};
  child.address[a] = 2 * box.address[a] + side;
  ++child.level[a];
  return child;
}

}  // namespace

CellRange MidpointBox::cells(const Levels& smallest) const {
  CellRange range;
  for (std::size_t a = 0; a < 3; ++a) {
    const int shift = smallest[a] - level[a];
    range.first[a] = address[a] << shift;
    range.last[a] = range.first[a] + (1u << shift) - 1;
  }
  return range;
}

std::vector<MidpointBox> subdivide(const GridGeometry& grid, MidpointBox root, const SubdivisionLimits& limits,
                                   Projection& projection) {
  std::vector<MidpointBox> boxes;
  std::size_t held = weight(root);
  std::vector<Pending> generation, next;
  generation.push_back({std::move(root), 0});
  // All boxes of one halving before the next, so that a limit on what they hold is felt by all alike.
  while (!generation.empty()) {
    for (Pending& pending : generation) {
      MidpointBox& box = pending.box;
      const int axis = box.primitives > limits.primitives ? next_axis(box, pending.axis, limits.levels) : -1;
      if (axis < 0 || held + weight(box) > limits.held) {
        boxes.push_back(std::move(box));
        continue;
      }
      held -= weight(box);
      for (std::uint32_t side = 0; side < 2; ++side) {
        MidpointBox child = half(box, axis, side);
        child.subtree = projection.project(box.subtree, grid.box(child.cells(limits.levels)));
        child.primitives = projection.count_primitives(child.subtree);
        held += weight(child);
        next.push_back({std::move(child), (axis + 1) % 3});
      }
      box.subtree = {};
    }
    generation.clear();
    std::swap(generation, next);
  }
  return boxes;
}

Levels highest_levels(const std::vector<MidpointBox>& boxes) {
  Levels highest{};
  for (const MidpointBox& box : boxes) {
    for (std::size_t a = 0; a < 3; ++a) highest[a] = std::max(highest[a], box.level[a]);
  }
  return highest;
}

GridGeometry midpoint_grid(const Box3& space, const Levels& levels) {
  return {space, counts(levels)};
}

Levels useful_levels(const Levels& wanted, const Box3& space, double thinnest) {
  Levels levels = wanted;
  for (int axis = 0; axis < 3; ++axis) {
    int& level = levels[static_cast<std::size_t>(axis)];
    while (level > 0 && space.size()[axis] / (1u << level) < thinnest) --level;
  }
  return levels;
}

int usual_level(std::size_t primitives) {
  int level = 1;
  for (std::size_t elements = 1; elements < primitives; elements *= 8) ++level;
  return std::clamp(level, 3, 8);
}

}  // namespace tenon
