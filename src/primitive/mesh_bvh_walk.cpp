#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "primitive/mesh_bvh.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "primitive/mesh_bvh_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#ifndef TENON_PRIMITIVE_MESH_BVH_WALK_ONCE_
#define TENON_PRIMITIVE_MESH_BVH_WALK_ONCE_
namespace tenon {

/// A line in the frame of a hierarchy, in single precision: at the height h along the axis that it mostly follows, it
/// lies at start + shear * h along the two others. How far it has come is h where it rises, and -h where it falls.
struct FloatLine {
  std::size_t axes[3];  // the one that it mostly follows, and the others
  float start[2], shear[2];
  // By axis: it meets a plane, near or far side of a box, when it has come plane * inverse - shift. Boxes are grown by
  // what the line is wrong by.
  float inverse[3], near_shift[3], far_shift[3];
  bool forward[3];
  // How far a corner may be from where it is computed, across the line.
  float error[2];
  float begin, end;        // the part that is asked for
  bool is_beside = false;  // it misses everything

  FloatLine(const MeshLine& line, const LineWindow& window, const MeshBvh::Frame& frame)
      : axes{static_cast<std::size_t>(line.along), static_cast<std::size_t>(line.across[0]),
             static_cast<std::size_t>(line.across[1])} {
    // u is what a float rounds by, and no coordinate here is larger than a few units. How far the line has come where
    // it meets a plane is wrong by the error of coordinates, across the plane, times the inverse.
    constexpr double u = 0x1p-24;
    // A mesh lies within 1 of the middle: at heights up to 1.25 no line meets it that passes at 3, if it is known to a
    // quarter.
    constexpr double beside = 3, quarter = 0.25;
    const Vec3 origin = frame.scale * (line.origin - frame.center), grown = 2 * frame.scale * line.growth;
    up_ = grown[line.along] + 4 * u;
    const auto limited = [](double value) { return value <= most ? value : unknown; };
    const double sign = line.direction[line.along] > 0 ? 1 : -1;
    come_at_0_ = sign * origin[line.along];
    speed_ = frame.scale * std::fabs(line.direction[line.along]);
    const double from = come_at_0_ + speed_ * window.begin;
    begin = static_cast<float>(std::fabs(from) <= most ? from - up_ : -unknown);
    end_at(window.end);
    set_slab(0, sign, 0, limited(up_));
    for (std::size_t i = 0; i < 2; ++i) {
      const int axis = line.across[i];
      // A slope that takes the line nowhere within the mesh may be any other such.
      constexpr double least = 0x1p-40;
      const double slope = std::fabs(line.shear[i]) < least ? least : line.shear[i];
      const double at_middle = origin[axis] - line.shear[i] * origin[line.along];
      // Of a corner its coordinates, the slope and their product round by u each, the start by 3 u, the differences by
      // 4 u and 5 u. Where a plane is met the product rounds by 2 u, the shift by 3 u, and the sum by as much as the
      // plane and the start are apart.
      const double slack = 32 * u * (1 + up_);
      // Twice what the line is wrong by covers the rounding in double here and there.
      const double wrong = 2 * frame.scale * line.shear_error[i];
      double growth = limited(grown[axis] + slack);
      error[i] = static_cast<float>(limited(wrong + 20 * u));
      const bool is_far = !(std::fabs(at_middle) <= beside);
      is_beside |= is_far && grown[axis] <= quarter && up_ <= quarter;
      start[i] = is_far ? 0 : static_cast<float>(at_middle);
      if (is_far) growth = error[i] = static_cast<float>(unknown);
      shear[i] = static_cast<float>(slope);
      set_slab(i + 1, sign / slope, is_far ? 0 : at_middle, growth);
    }
  }

  /// Asks for no more than what lies before t of the line.
  void end_at(double t) {
    const double far = come_at_0_ + speed_ * t;
    end = static_cast<float>(far <= most ? std::max(far + up_, -unknown) : unknown);
  }

 private:
  static constexpr double unknown = 0x1p60, most = 0x1p20;

  void set_slab(std::size_t i, double inverse_slope, double place, double growth) {
    forward[i] = inverse_slope > 0;
    const double grow = forward[i] ? growth : -growth;
    inverse[i] = static_cast<float>(inverse_slope);
    near_shift[i] = static_cast<float>((place + grow) * inverse_slope);
    far_shift[i] = static_cast<float>((place - grow) * inverse_slope);
  }

  double come_at_0_, speed_, up_;
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

/// A line, as many times as a node has children, or a vector has room for.
class WideLine {
 public:
  using V = hn::Vec<Wide>;

  explicit WideLine(const FloatLine& line) : begin_(hn::Set(Wide(), line.begin)) {
    for (std::size_t i = 0; i < 3; ++i) {
      inverse_[i] = hn::Set(Wide(), line.inverse[i]);
      near_shift_[i] = hn::Set(Wide(), line.near_shift[i]);
      far_shift_[i] = hn::Set(Wide(), line.far_shift[i]);
      near_[i] = (2 * line.axes[i] + (line.forward[i] ? 0 : 1)) * MeshBvh::width;
      far_[i] = (2 * line.axes[i] + (line.forward[i] ? 1 : 0)) * MeshBvh::width;
    }
  }

  /// The children whose boxes the line may meet.
  /// @param end        of the part of the line that matters
  /// @param entrances  becomes how far it has come where it does
  HWY_INLINE std::uint32_t Meet(const MeshBvh::Node& node, float end, float (&entrances)[MeshBvh::width]) const {
    const Wide wide;
    const float* const ends = node.ends[0][0].data();
    std::uint32_t met = 0;
    for (std::size_t lane = 0; lane < MeshBvh::width; lane += hn::Lanes(wide)) {
      V enter = begin_, leave = hn::Set(wide, end);
      for (std::size_t i = 0; i < 3; ++i) {
        enter = hn::Max(enter, hn::MulSub(hn::Load(wide, ends + near_[i] + lane), inverse_[i], near_shift_[i]));
        leave = hn::Min(leave, hn::MulSub(hn::Load(wide, ends + far_[i] + lane), inverse_[i], far_shift_[i]));
      }
      hn::Store(enter, wide, entrances + lane);
      met |= BitsOf(wide, hn::Le(enter, leave), lane);
    }
    return met;
  }

 private:
  V inverse_[3], near_shift_[3], far_shift_[3], begin_;
  std::size_t near_[3], far_[3];  // where a node has the ends that are met first and last
};

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
      const V height = hn::Load(wide, axes[line.axes[0]].data() + lane);
      const auto project = [&](std::size_t i) HWY_ATTR {
        const V place = hn::Sub(hn::Load(wide, axes[line.axes[i + 1]].data() + lane), hn::Set(wide, line.start[i]));
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

/// Calls visit(triangle) for what the line may cross of a leaf.
template <class Visit>
HWY_INLINE void VisitLeaf(const MeshBvh& bvh, const FloatLine& line, std::uint32_t leaf, const Visit& visit) {
  const auto triangles = bvh.leaf(leaf);
  const auto blocks = bvh.blocks();
  std::uint32_t crossed = (1U << triangles.size()) - 1;
  if (!blocks.empty()) crossed &= MeetTriangles(line, blocks[leaf]);
  for (; crossed != 0; crossed &= crossed - 1) {
    const std::uint32_t triangle = triangles[static_cast<std::size_t>(std::countr_zero(crossed))];
    if (triangle != MeshBvh::none) visit(triangle);
  }
}

void Walk(const MeshBvh& bvh, const FloatLine& line, FunctionRef<void(std::uint32_t)> visit) {
  const auto nodes = bvh.nodes();
  const WideLine wide_line(line);
  std::uint32_t stack[MeshBvh::stack_size];
  std::size_t top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const MeshBvh::Node& node = nodes[stack[--top]];
    HWY_ALIGN float entrances[MeshBvh::width];
    for (std::uint32_t met = wide_line.Meet(node, line.end, entrances); met != 0; met &= met - 1) {
      const MeshBvh::Child child = node.children[static_cast<std::size_t>(std::countr_zero(met))];
      if (child.is_leaf()) {
        VisitLeaf(bvh, line, child.index(), visit);
      } else if (!child.is_none()) {
        stack[top++] = child.index();
      }
    }
  }
}

void WalkForward(const MeshBvh& bvh, FloatLine& line, FunctionRef<double(std::uint32_t)> visit) {
  const MeshBvh::Node* const nodes = bvh.nodes().data();
  const WideLine wide_line(line);
  struct Pending {
    std::uint32_t child;
    float entrance;
  };
  Pending stack[MeshBvh::stack_size];
  std::size_t top = 0;
  MeshBvh::Child child{};
  const auto take = [&](std::uint32_t triangle) { line.end_at(visit(triangle)); };
  for (;;) {
    std::uint32_t met = 0;
    if (child.is_leaf()) {
      VisitLeaf(bvh, line, child.index(), take);
    } else {
      const MeshBvh::Node& node = nodes[child.index()];
      HWY_ALIGN float entrances[MeshBvh::width];
      met = wide_line.Meet(node, line.end, entrances);
      if (met != 0) {
        // The nearest is taken at once, the others wait, the farthest below.
        const auto pending = [&](std::uint32_t bits) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
          return Pending{node.children[lane].bits, entrances[lane]};
        };
        const std::size_t bottom = top;
        Pending nearest = pending(met);
        for (std::uint32_t left = met & (met - 1); left != 0; left &= left - 1) {
          Pending other = pending(left);
          if (other.entrance < nearest.entrance) std::swap(other, nearest);
          std::size_t at = top++;
          for (; at > bottom && stack[at - 1].entrance < other.entrance; --at) stack[at] = stack[at - 1];
          stack[at] = other;
        }
        child.bits = nearest.child;
      }
    }
    while (met == 0) {
      if (top == 0) return;
      child.bits = stack[--top].child;
      met = stack[top].entrance <= line.end;
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(Walk);
HWY_EXPORT(WalkForward);

void MeshBvh::walk(const MeshLine& line, const LineWindow& window, FunctionRef<void(std::uint32_t)> visit) const {
  if (nodes_.empty()) return;
  const FloatLine float_line(line, window, frame_);
  if (!float_line.is_beside) HWY_DYNAMIC_DISPATCH(Walk)(*this, float_line, visit);
}

void MeshBvh::walk_forward(const MeshLine& line, const LineWindow& window,
                           FunctionRef<double(std::uint32_t)> visit) const {
  if (nodes_.empty()) return;
  FloatLine float_line(line, window, frame_);
  if (!float_line.is_beside) HWY_DYNAMIC_DISPATCH(WalkForward)(*this, float_line, visit);
}

}  // namespace tenon
#endif
