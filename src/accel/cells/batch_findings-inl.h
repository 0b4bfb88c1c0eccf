// What was found of each ray of a batch. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_
#undef TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_
#else
#define TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "accel/cells/crossing_group.h"
#include "accel/cells/ray_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// What plain arithmetic has found of the rays of a batch.
class BatchFindings {
 public:
  using D = RayBatch::D;
  using U = hn::RebindToUnsigned<D>;

  HWY_ALIGN double t[RayBatch::most_rays];  ///< of the first boundary so far, counted from the start
  std::uint64_t unsure = 0;                 ///< rays that are left to SingleTracer

  /// A boundary, or one a lane.
  template <class Number, class Word, class Condition>
  struct BoundaryOf {
    Number t;
    Word cell, leaf;
    Word before, behind;  ///< the values of the cell's points
    Word coincident;      ///< CoincidentEnds, where several faces coincide there
    Condition enters;     ///< the ray enters the leaf
  };
  using Boundary = BoundaryOf<double, std::uint64_t, bool>;
  using Boundaries = BoundaryOf<hn::Vec<D>, hn::Vec<U>, hn::Mask<D>>;

  void Clear(const RayBatch& rays) {
    const D d;
    const U u;
    for (std::size_t i = 0; i < rays.padded; i += RayBatch::double_lanes) {
      hn::Store(hn::Set(d, std::numeric_limits<double>::infinity()), d, &t[i]);
      hn::Store(hn::Set(u, nowhere), u, &place_[i]);
      hn::Store(hn::Zero(u), u, &how_[i]);
    }
    unsure = rays.unsound;
  }

  std::uint32_t cell(std::size_t i) const { return static_cast<std::uint32_t>(place_[i] >> 32); }
  LeafId leaf(std::size_t i) const { return LeafId{static_cast<std::uint32_t>(place_[i])}; }
  bool enters(std::size_t i) const { return (how_[i] & entering) != 0; }
  CoincidentEnds coincident(std::size_t i) const { return {static_cast<std::uint32_t>(how_[i] >> coincident_bits)}; }
  /// Of the rays in a vector of lanes those that enter their leaf.
  hn::Mask<D> Entering(std::size_t at) const { return HasBit(at, 0); }
  /// The value of the points behind the boundary.
  std::uint8_t behind(std::size_t i) const { return static_cast<std::uint8_t>(how_[i] >> behind_bits); }
  void TakeValues(std::size_t i, CellAnswer& answer) const {
    answer.before = static_cast<std::uint8_t>(how_[i] >> before_bits);
    answer.after = behind(i);
  }

  /// The rays that have a boundary, a bit each. @param padded  of the batch
  std::uint64_t Met(std::size_t padded) const {
    return Where(padded, [&](U u, std::size_t i) { return hn::Ne(hn::Load(u, &place_[i]), hn::Set(u, nowhere)); });
  }
  /// Those at whose boundary several faces coincide.
  std::uint64_t Groups(std::size_t padded) const {
    return Where(padded, [&](U u, std::size_t i) {
      return hn::Ne(hn::ShiftRight<coincident_bits>(hn::Load(u, &how_[i])), hn::Zero(u));
    });
  }
  /// Of the rays in a vector of lanes those that enter, or leave, a leaf at whose boundary several faces coincide.
  /// @param place  of that leaf in the cell
  hn::Mask<D> EnteringAmong(std::size_t at, std::uint32_t place) const { return HasBit(at, coincident_bits + place); }
  hn::Mask<D> LeavingAmong(std::size_t at, std::uint32_t place) const {
    return HasBit(at, coincident_bits + CoincidentEnds::left_shift + place);
  }
  /// Of the rays in a vector of lanes those whose boundary lies on the same leaf as that of ray i, or in the same cell.
  std::uint32_t SameLeaf(std::size_t at, std::size_t i) const { return SamePlace(at, i, 0xffffffff); }
  std::uint32_t SameCell(std::size_t at, std::size_t i) const { return SamePlace(at, i, 0xffffffff00000000); }

  /// Keeps a boundary unless a nearer one is known: nothing behind it counts from now on.
  /// @param any_will_do  whether one that certainly lies before the ray's end makes an end of it
  HWY_INLINE void Keep(RayBatch& rays, std::size_t i, const Boundary& boundary, bool any_will_do) {
    if (!(boundary.t < t[i])) return;
    t[i] = boundary.t;
    place_[i] = boundary.cell << 32 | boundary.leaf;
    how_[i] = (boundary.enters ? entering : 0) | boundary.before << before_bits | boundary.behind << behind_bits |
              boundary.coincident << coincident_bits;
    // Rounded up, for cells whose boxes overlap by the slack.
    const bool is_done = any_will_do && boundary.t + rays.start[i] + 2 * rays.near[i] < rays.end[i];
    rays.box_end[i] = is_done ? -1 : std::min(rays.box_end[i], static_cast<float>(boundary.t * rounded_up));
  }

  /// The same for those of a vector of lanes that have one. @return whether any is kept
  HWY_INLINE bool Keep(RayBatch& rays, std::size_t at, hn::Mask<D> met, const Boundaries& boundary, bool any_will_do) {
    const D d;
    const U u;
    const auto best = hn::Load(d, &t[at]);
    const auto better = hn::And(met, hn::Lt(boundary.t, best));
    if (hn::AllFalse(d, better)) return false;
    const auto keep = hn::RebindMask(u, better);
    hn::Store(hn::IfThenElse(better, boundary.t, best), d, &t[at]);
    const auto place = hn::Or(hn::ShiftLeft<32>(boundary.cell), boundary.leaf);
    hn::Store(hn::IfThenElse(keep, place, hn::Load(u, &place_[at])), u, &place_[at]);
    const auto flags = hn::Or(hn::IfThenElseZero(hn::RebindMask(u, boundary.enters), hn::Set(u, entering)),
                              hn::ShiftLeft<coincident_bits>(boundary.coincident));
    const auto values =
        hn::Or(hn::ShiftLeft<before_bits>(boundary.before), hn::ShiftLeft<behind_bits>(boundary.behind));
    hn::Store(hn::IfThenElse(keep, hn::Or(flags, values), hn::Load(u, &how_[at])), u, &how_[at]);

    const RayBatch::HalfF half;
    const auto end = hn::PromoteTo(d, hn::Load(half, &rays.box_end[at]));
    auto shorter = hn::Min(end, hn::Mul(boundary.t, hn::Set(d, rounded_up)));
    if (any_will_do) {
      const auto near = hn::Load(d, &rays.near[at]), start = hn::Load(d, &rays.start[at]);
      const auto behind = hn::MulAdd(hn::Set(d, 2.0), near, hn::Add(boundary.t, start));
      shorter = hn::IfThenElse(hn::Lt(behind, hn::Load(d, &rays.end[at])), hn::Set(d, -1.0), shorter);
    }
    hn::Store(hn::DemoteTo(half, hn::IfThenElse(better, shorter, end)), half, &rays.box_end[at]);
    return true;
  }

  /// Has a ray traced no further, but by SingleTracer.
  void Drop(RayBatch& rays, std::size_t i) {
    unsure |= std::uint64_t{1} << i;
    rays.box_end[i] = -1;
  }

 private:
  static constexpr std::uint64_t entering = 1;
  static constexpr int before_bits = 8, behind_bits = 16, coincident_bits = 24;
  static_assert(coincident_bits + CoincidentEnds::bits <= 64);
  static constexpr std::uint64_t nowhere = ~std::uint64_t{0};
  static constexpr double rounded_up = 1 + 0x1p-20;

  template <class Condition>
  std::uint64_t Where(std::size_t padded, const Condition& condition) const {
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < padded; i += RayBatch::double_lanes) {
      rays |= static_cast<std::uint64_t>(RayBatch::Bits(hn::RebindMask(D(), condition(U(), i)))) << i;
    }
    return rays;
  }

  hn::Mask<D> HasBit(std::size_t at, std::uint32_t bit) const {
    const U u;
    return hn::RebindMask(D(), hn::TestBit(hn::Load(u, &how_[at]), hn::Set(u, std::uint64_t{1} << bit)));
  }

  std::uint32_t SamePlace(std::size_t at, std::size_t i, std::uint64_t part) const {
    const U u;
    const auto mask = hn::Set(u, part);
    const auto same = hn::Eq(hn::And(hn::Load(u, &place_[at]), mask), hn::Set(u, place_[i] & part));
    return RayBatch::Bits(hn::RebindMask(D(), same));
  }

  HWY_ALIGN std::uint64_t place_[RayBatch::most_rays];  // the cell, in the upper half, and the leaf; or `nowhere`
  HWY_ALIGN std::uint64_t how_[RayBatch::most_rays];    // `entering`, and from these bits on, values and CoincidentEnds
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
