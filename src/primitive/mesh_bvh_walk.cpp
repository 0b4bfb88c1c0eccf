#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "primitive/mesh_bvh.h"
#include "primitive/mesh_float_line.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "primitive/mesh_bvh_walk.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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
/// FindArea() (mesh_candidate-inl.h) says of errors holds here as well.
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
        if (top > 0 && !MeshBvh::Child{stack[top - 1].child}.is_leaf())
          __builtin_prefetch(&nodes[stack[top - 1].child]);
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
  FloatLine float_line(line, window, frame_);
  walk_forward(float_line, visit);
}

void MeshBvh::walk_forward(FloatLine& line, FunctionRef<double(std::uint32_t)> visit) const {
  if (nodes_.empty() || line.is_beside) return;
  HWY_DYNAMIC_DISPATCH(WalkForward)(*this, line, visit);
}

}  // namespace tenon
#endif
