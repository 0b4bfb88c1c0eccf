#include <algorithm>
#include <bit>
#include <cmath>

#include "primitive/mesh_bvh.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "primitive/mesh_bvh_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TENON_PRIMITIVE_MESH_BVH_WALK_ONCE_
#define TENON_PRIMITIVE_MESH_BVH_WALK_ONCE_
namespace tenon {

/// A line in the frame of a hierarchy, in single precision: at the height h along the axis that it mostly follows, it
/// lies at start + shear * h along the two others.
struct FloatLine {
  std::size_t along, across[2];
  float start[2], shear[2], inverse[2];
  // How far boxes are grown: u = 2^-24 is what a float rounds by, and nothing here is larger than a few units.
  float growth_along, near_begin[2], far_begin[2];
  // How far a corner may be from where it is computed, across the line.
  float error[2];
  float lowest, highest;   // the heights of the part that is asked for
  bool is_beside = false;  // it misses everything
  bool forward[2];

  FloatLine(const MeshLine& line, const LineWindow& window, const MeshBvh::Frame& frame)
      : along(static_cast<std::size_t>(line.along)) {
    constexpr double u = 0x1p-24, unknown = 0x1p60, most = 0x1p20;
    // A mesh lies within 1 of the middle: at heights up to 1.25 no line meets it that passes at 3, if it is known to a
    // quarter.
    constexpr double beside = 3, quarter = 0.25;
    const Vec3 origin = frame.scale * (line.origin - frame.center), grown = 2 * frame.scale * line.growth;
    const double up = grown[line.along] + 4 * u;
    const auto limited = [](double value) { return static_cast<float>(value <= most ? value : unknown); };
    growth_along = limited(up);
    const bool rises = line.direction[line.along] > 0;
    const auto height = [&](double t) { return origin[line.along] + frame.scale * t * line.direction[line.along]; };
    const double low = height(rises ? window.begin : window.end), high = height(rises ? window.end : window.begin);
    lowest = static_cast<float>(std::fabs(low) <= most ? low - up : -unknown);
    highest = static_cast<float>(std::fabs(high) <= most ? high + up : unknown);
    for (std::size_t i = 0; i < 2; ++i) {
      const int axis = line.across[i];
      across[i] = static_cast<std::size_t>(axis);
      // A slope that takes the line nowhere within the mesh may be any other such.
      constexpr double least = 0x1p-40;
      const double slope = std::fabs(line.shear[i]) < least ? least : line.shear[i];
      const double at_middle = origin[axis] - line.shear[i] * origin[line.along];
      // Of a corner its coordinates, the slope and their product round by u each, the start by 3 u, the differences by
      // 4 u and 5 u. Where a plane is met these round, too, and the quotient by 2 u of a height of 1 + up.
      const double slack = 32 * u * (1 + up);
      // Twice what the line is wrong by covers the rounding in double here and there.
      const double wrong = 2 * frame.scale * line.shear_error[i];
      float growth = limited(grown[axis] + slack);
      error[i] = limited(wrong + 20 * u);
      const bool is_far = !(std::fabs(at_middle) <= beside);
      is_beside |= is_far && grown[axis] <= quarter && up <= quarter;
      start[i] = is_far ? 0 : static_cast<float>(at_middle);
      if (is_far) growth = error[i] = static_cast<float>(unknown);
      shear[i] = static_cast<float>(slope);
      inverse[i] = static_cast<float>(1 / slope);
      forward[i] = slope > 0;
      near_begin[i] = start[i] + (forward[i] ? growth : -growth);
      far_begin[i] = start[i] - (forward[i] ? growth : -growth);
    }
  }
};

}  // namespace tenon
#endif

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Wide = hn::CappedTag<float, MeshBvh::width>;

/// Bits of the lanes of a mask, from the lane on.
template <class Mask>
HWY_INLINE std::uint32_t BitsOf(Wide wide, Mask mask, std::size_t lane) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(wide, mask, bits);
  return static_cast<std::uint32_t>(bits[0]) << lane;
}

/// The children whose boxes the line may meet.
HWY_INLINE std::uint32_t MeetBoxes(const FloatLine& line, const MeshBvh::Node& node) {
  const Wide wide;
  std::uint32_t met = 0;
  for (std::size_t lane = 0; lane < MeshBvh::width; lane += hn::Lanes(wide)) {
    const auto up = hn::Set(wide, line.growth_along);
    auto enter = hn::Sub(hn::Load(wide, node.lower[line.along].data() + lane), up);
    auto leave = hn::Add(hn::Load(wide, node.upper[line.along].data() + lane), up);
    enter = hn::Max(enter, hn::Set(wide, line.lowest));
    leave = hn::Min(leave, hn::Set(wide, line.highest));
    for (std::size_t i = 0; i < 2; ++i) {
      const std::size_t axis = line.across[i];
      const auto& near = line.forward[i] ? node.lower[axis] : node.upper[axis];
      const auto& far = line.forward[i] ? node.upper[axis] : node.lower[axis];
      const auto inverse = hn::Set(wide, line.inverse[i]);
      const auto near_begin = hn::Set(wide, line.near_begin[i]), far_begin = hn::Set(wide, line.far_begin[i]);
      enter = hn::Max(enter, hn::Mul(hn::Sub(hn::Load(wide, near.data() + lane), near_begin), inverse));
      leave = hn::Min(leave, hn::Mul(hn::Sub(hn::Load(wide, far.data() + lane), far_begin), inverse));
    }
    met |= BitsOf(wide, hn::Le(enter, leave), lane);
  }
  return met;
}

/// The triangles that the line may cross: of whose edges none certainly passes it on the other side than another. What
/// edge_area() (mesh_candidate.cpp) says of errors holds here as well.
HWY_INLINE std::uint32_t MeetTriangles(const FloatLine& line, const MeshBvh::Block& block) {
  const Wide wide;
  using V = hn::Vec<Wide>;
  std::uint32_t met = 0;
  for (std::size_t lane = 0; lane < MeshBvh::width; lane += hn::Lanes(wide)) {
    V x[3], y[3];
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const auto& axes = block.corners[corner];
      const V height = hn::Load(wide, axes[line.along].data() + lane);
      const auto project = [&](std::size_t i) HWY_ATTR {
        const V place = hn::Sub(hn::Load(wide, axes[line.across[i]].data() + lane), hn::Set(wide, line.start[i]));
        return hn::Sub(place, hn::Mul(hn::Set(wide, line.shear[i]), height));
      };
      x[corner] = project(0);
      y[corner] = project(1);
    }
    const V twice_x = hn::Set(wide, 2 * line.error[0]), twice_y = hn::Set(wide, 2 * line.error[1]);
    const V both = hn::Set(wide, 4 * line.error[0] * line.error[1]);
    auto positive = hn::Lt(both, hn::Zero(wide)), negative = positive;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3;
      const V area = hn::Sub(hn::Mul(x[i], y[j]), hn::Mul(y[i], x[j]));
      const V across_x = hn::Add(hn::Abs(x[i]), hn::Abs(x[j])), across_y = hn::Add(hn::Abs(y[i]), hn::Abs(y[j]));
      const V error = hn::Add(hn::Add(hn::Mul(across_x, twice_y), hn::Mul(across_y, twice_x)), both);
      positive = hn::Or(positive, hn::Gt(area, error));
      negative = hn::Or(negative, hn::Lt(area, hn::Neg(error)));
    }
    met |= BitsOf(wide, hn::Not(hn::And(positive, negative)), lane);
  }
  return met;
}

void Walk(const MeshBvh& bvh, const FloatLine& line, FunctionRef<void(std::uint32_t)> visit) {
  const auto nodes = bvh.nodes();
  const auto blocks = bvh.blocks();
  std::uint32_t stack[MeshBvh::stack_size];
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const MeshBvh::Node& node = nodes[stack[--top]];
    for (std::uint32_t met = MeetBoxes(line, node); met != 0; met &= met - 1) {
      const MeshBvh::Child child = node.children[static_cast<std::size_t>(std::countr_zero(met))];
      if (child.is_none()) continue;
      if (!child.is_leaf()) {
        stack[top++] = child.index();
        continue;
      }
      const auto triangles = bvh.leaf(child.index());
      std::uint32_t crossed = (1U << triangles.size()) - 1;
      if (!blocks.empty()) crossed &= MeetTriangles(line, blocks[child.index()]);
      for (; crossed != 0; crossed &= crossed - 1) {
        const std::uint32_t triangle = triangles[static_cast<std::size_t>(std::countr_zero(crossed))];
        if (triangle != MeshBvh::none) visit(triangle);
      }
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(Walk);

void MeshBvh::walk(const MeshLine& line, const LineWindow& window, FunctionRef<void(std::uint32_t)> visit) const {
  if (nodes_.empty()) return;
  const FloatLine float_line(line, window, frame_);
  if (!float_line.is_beside) HWY_DYNAMIC_DISPATCH(Walk)(*this, float_line, visit);
}

}  // namespace tenon
#endif
