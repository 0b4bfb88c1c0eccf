#include "accel/cells/leaf_lanes.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/cells/leaf_lanes.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::CappedTag<double, LeafLanes::width>;

template <class Mask>
HWY_INLINE std::uint32_t BitsOf(Mask mask) {
  std::uint8_t bits[8];
  hn::StoreMaskBits(D(), mask, bits);
  return bits[0];
}

// What an interval along an axis says of the leaves.
struct IntervalView {
  hn::Vec<D> nearest, farthest;  // squares of distances
  hn::Mask<D> apart, within;
};

HWY_INLINE IntervalView See(const LeafLanes::Axis& leaves, std::size_t lane, double low, double high) {
  const D d;
  const auto from = hn::Set(d, low), to = hn::Set(d, high);
  const auto center = hn::Load(d, &leaves.center[lane]), round = hn::Load(d, &leaves.round[lane]);
  const auto below = hn::Sub(from, center), above = hn::Sub(center, to);
  const auto near = hn::Max(hn::Max(below, above), hn::Zero(d)), far = hn::Min(below, above);
  return {
      hn::Mul(round, hn::Mul(near, near)), hn::Mul(round, hn::Mul(far, far)),
      hn::Or(hn::Gt(hn::Load(d, &leaves.low[lane]), to), hn::Gt(from, hn::Load(d, &leaves.high[lane]))),
      hn::And(hn::Ge(from, hn::Load(d, &leaves.inner_low[lane])), hn::Le(to, hn::Load(d, &leaves.inner_high[lane])))};
}

void ClassifySides(const LeafLanes& leaves, const Box3& box, std::span<const SplitPlane> planes, double growth,
                   std::span<SideRegions> sides) {
  const D d;
  for (SideRegions& side : sides) side = {};
  for (std::size_t lane = 0; lane < LeafLanes::width; lane += hn::Lanes(d)) {
    const auto outer = hn::Load(d, &leaves.outer_square[lane]), inner = hn::Load(d, &leaves.inner_square[lane]);
    IntervalView whole[3];
    for (int a = 0; a < 3; ++a) {
      whole[a] = See(leaves.axes[static_cast<std::size_t>(a)], lane, box.lower[a], box.upper[a]);
    }
    for (std::size_t i = 0; i < planes.size(); ++i) {
      const int axis = planes[i].axis;
      const double position = planes[i].position;
      const IntervalView &b = whole[(axis + 1) % 3], &c = whole[(axis + 2) % 3];
      const auto nearest = hn::Add(b.nearest, c.nearest), farthest = hn::Add(b.farthest, c.farthest);
      const auto apart = hn::Or(b.apart, c.apart), within = hn::And(b.within, c.within);
      const auto classify = [&](double low, double high, TableRegions& regions) HWY_ATTR {
        const IntervalView own = See(leaves.axes[static_cast<std::size_t>(axis)], lane, low, high);
        const auto outside = hn::Or(hn::Gt(hn::Add(nearest, own.nearest), outer), hn::Or(apart, own.apart));
        const auto inside = hn::And(hn::Lt(hn::Add(farthest, own.farthest), inner), hn::And(within, own.within));
        const std::uint32_t outside_bits = BitsOf(outside);
        regions.outside |= outside_bits << lane;
        regions.inside |= (BitsOf(inside) & ~outside_bits) << lane;
      };
      classify(box.lower[axis], position + growth, sides[i][0]);
      classify(position - growth, box.upper[axis], sides[i][1]);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon::cells {

void LeafLanes::set(std::size_t lane, const RegionLeaf& leaf, double margin) {
  const bool plain = leaf.kind == RegionLeaf::Kind::plain;
  for (int a = 0; a < 3; ++a) {
    Axis& axis = axes[static_cast<std::size_t>(a)];
    const bool round = plain && leaf.is_round_along(a);
    axis.center[lane] = leaf.center[a];
    axis.round[lane] = round ? 1 : 0;
    axis.low[lane] = leaf.bounds.lower[a];
    axis.high[lane] = leaf.bounds.upper[a];
    axis.inner_low[lane] = round ? -Box3::inf : leaf.bounds.lower[a] + margin;
    axis.inner_high[lane] = round ? Box3::inf : leaf.bounds.upper[a] - margin;
  }
  outer_square[lane] = plain ? leaf.outer_square : Box3::inf;
  inner_square[lane] = plain ? leaf.inner_square : 0;
  shaped = (shaped & ~(1U << lane)) | static_cast<std::uint32_t>(!plain) << lane;
}

HWY_EXPORT(ClassifySides);

void classify_sides(const LeafLanes& leaves, const Box3& box, std::span<const SplitPlane> planes, double growth,
                    std::span<SideRegions> sides) {
  HWY_DYNAMIC_DISPATCH(ClassifySides)(leaves, box, planes, growth, sides);
}

}  // namespace tenon::cells
#endif
