// Rays through cells whose expression is a truth table, one ray a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_TABLE_WALK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_TABLE_WALK_INL_H_
#undef TENON_ACCEL_CELLS_TABLE_WALK_INL_H_
#else
#define TENON_ACCEL_CELLS_TABLE_WALK_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "accel/cells/cell.h"
#include "accel/cells/crossing_group.h"
#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Where rays meet the leaves of their cells, and what comes of it.
template <class D>
struct TableWalk {
  using U = hn::RebindToUnsigned<D>;

  /// By place in the cell; `never` where a leaf is not met.
  hn::Vec<D> enter[Cell::most_tabled], leave[Cell::most_tabled];
  hn::Mask<D> unsure;  ///< told by whoever fills in the above, too

  hn::Mask<D> met;            ///< the value changes at t
  hn::Mask<D> enters;         ///< the ray enters the leaf that it meets
  hn::Vec<U> before, behind;  ///< the values of the points before and behind
  hn::Vec<D> t;
  hn::Vec<U> place;       ///< of the leaf that is met
  hn::Vec<U> coincident;  ///< where several faces coincide there, CoincidentEnds

  static constexpr double never = std::numeric_limits<double>::infinity();

  /// Follows the rays of `lanes` from t_in to t_out.
  /// @param count  the most leaves of any cell
  /// @param near, together  crossings no further apart may be one boundary, or certainly are
  void Follow(D d, std::uint32_t count, hn::Mask<D> lanes, hn::Vec<U> table, hn::Vec<D> t_in, hn::Vec<D> t_out,
              hn::Vec<D> near, hn::Vec<D> together) {
    if (count == 1) return FollowLeaf(lanes, table, t_in, t_out);
    const hn::Vec<U> tables[] = {table};
    Follow(d, count, lanes, tables, t_in, t_out, near, together);
  }

  /// The same for values of several bits, each of which has its table.
  template <std::size_t bits>
  HWY_INLINE void Follow(D d, std::uint32_t count, hn::Mask<D> lanes, const hn::Vec<U> (&tables)[bits], hn::Vec<D> t_in,
                         hn::Vec<D> t_out, hn::Vec<D> near, hn::Vec<D> together) {
    const U u;
    const auto nowhere = hn::Set(d, never);
    hn::Mask<D> within[Cell::most_tabled];
    hn::Vec<D> next[Cell::most_tabled];
    for (std::uint32_t i = 0; i < count; ++i) {
      within[i] = hn::And(hn::Le(enter[i], t_in), hn::Lt(t_in, leave[i]));
      const auto ahead = hn::IfThenElse(hn::Gt(enter[i], t_in), enter[i], nowhere);
      next[i] = hn::IfThenElse(within[i], leave[i], ahead);
    }
    unsure = hn::And(unsure, lanes);
    met = enters = hn::Lt(near, hn::Zero(d));  // none yet
    t = nowhere;
    place = before = behind = coincident = hn::Zero(u);
    auto first = Earliest(count, next);
    auto active = hn::And(hn::AndNot(unsure, lanes), hn::Le(first, t_out));
    if (hn::AllFalse(d, active)) return;

    const auto one = hn::Set(u, 1);
    auto state = hn::Zero(u);
    for (std::uint32_t i = 0; i < count; ++i) {
      state = hn::Or(state, hn::IfThenElseZero(hn::RebindMask(u, within[i]), hn::Set(u, std::uint64_t{1} << i)));
    }
    before = ValueOf(tables, state);
    // Of values of several bits it is followed whether they are that one.
    const auto table = bits > 1 ? StatesOf(tables, before) : tables[0];
    const auto start = bits > 1 ? one : before;
    for (; !hn::AllFalse(d, active); first = Earliest(count, next), active = hn::And(active, hn::Le(first, t_out))) {
      for (std::uint32_t i = count; i-- > 0;) {
        const auto crossed = hn::And(active, hn::Eq(next[i], first));
        const auto leaving = hn::Eq(leave[i], first);
        state = hn::Xor(state, hn::IfThenElseZero(hn::RebindMask(u, crossed), hn::Set(u, std::uint64_t{1} << i)));
        next[i] = hn::IfThenElse(crossed, hn::IfThenElse(leaving, nowhere, leave[i]), next[i]);
        place = hn::IfThenElse(hn::RebindMask(u, crossed), hn::Set(u, i), place);
        enters = hn::Or(hn::AndNot(crossed, enters), hn::AndNot(leaving, crossed));
      }
      const auto value = hn::And(hn::Shr(table, state), one);
      auto changed = hn::AndNot(hn::RebindMask(d, hn::Eq(value, start)), active);
      if (hn::AllFalse(d, changed)) continue;
      if (count > 1) {
        const auto crowd = hn::AndNot(IsAlone(d, count, first, near), changed);
        if (!hn::AllFalse(d, crowd)) {
          hn::Mask<D> cancels, doubtful;
          hn::Vec<U> ends;
          MeetGroup(d, count, first, near, together, crowd, table, start, state, next, cancels, doubtful, ends);
          unsure = hn::Or(unsure, doubtful);
          changed = hn::AndNot(hn::Or(cancels, doubtful), changed);
          active = hn::AndNot(doubtful, active);
          coincident = hn::IfThenElse(hn::RebindMask(u, hn::And(crowd, changed)), ends, coincident);
        }
      }
      t = hn::IfThenElse(changed, first, t);
      met = hn::Or(met, changed);
      active = hn::AndNot(changed, active);
    }
    behind = bits > 1 ? ValueOf(tables, state) : hn::Xor(before, one);
  }

 private:
  // Where the only leaf of a cell is crossed the value changes. No other crossing is near, for an interval that is
  // certain is longer.
  HWY_INLINE void FollowLeaf(hn::Mask<D> lanes, hn::Vec<U> table, hn::Vec<D> t_in, hn::Vec<D> t_out) {
    const U u;
    const auto one = hn::Set(u, 1);
    const auto inside = hn::Le(enter[0], t_in);
    unsure = hn::And(unsure, lanes);
    t = hn::IfThenElse(inside, leave[0], enter[0]);
    met = hn::And(hn::AndNot(unsure, lanes), hn::And(hn::Gt(t, t_in), hn::Le(t, t_out)));
    enters = hn::Not(inside);
    before = hn::And(hn::Shr(table, hn::IfThenElseZero(hn::RebindMask(u, inside), one)), one);
    behind = hn::Xor(before, one);
    place = coincident = hn::Zero(u);
  }

  static HWY_INLINE hn::Vec<D> Earliest(std::uint32_t count, const hn::Vec<D>* next) {
    auto first = hn::Set(D(), never);
    for (std::uint32_t i = 0; i < count; ++i) first = hn::Min(first, next[i]);
    return first;
  }

  template <std::size_t bits>
  static HWY_INLINE hn::Vec<U> ValueOf(const hn::Vec<U> (&tables)[bits], hn::Vec<U> state) {
    const U u;
    auto value = hn::And(hn::Shr(tables[0], state), hn::Set(u, 1));
    for (std::size_t b = 1; b < bits; ++b) {
      const auto bit = hn::Set(u, std::uint64_t{1} << b);
      const auto is_set = hn::Ne(hn::And(hn::Shr(tables[b], state), hn::Set(u, 1)), hn::Zero(u));
      value = hn::Or(value, hn::IfThenElseZero(is_set, bit));
    }
    return value;
  }

  // The truth table of having a value.
  template <std::size_t bits>
  static HWY_INLINE hn::Vec<U> StatesOf(const hn::Vec<U> (&tables)[bits], hn::Vec<U> value) {
    const U u;
    auto states = hn::Set(u, TruthTable::always);
    for (std::size_t b = 0; b < bits; ++b) {
      const auto is_set = hn::Ne(hn::And(value, hn::Set(u, std::uint64_t{1} << b)), hn::Zero(u));
      states = hn::And(states, hn::IfThenElse(is_set, tables[b], hn::Not(tables[b])));
    }
    return states;
  }

  HWY_INLINE hn::Mask<D> IsAlone(D d, std::uint32_t count, hn::Vec<D> at, hn::Vec<D> near) const {
    const auto unit = hn::Set(d, 1.0);
    auto ends = hn::Zero(d);
    for (std::uint32_t i = 0; i < count; ++i) {
      ends = hn::Add(ends, hn::IfThenElseZero(hn::Le(hn::Abs(hn::Sub(enter[i], at)), near), unit));
      ends = hn::Add(ends, hn::IfThenElseZero(hn::Le(hn::Abs(hn::Sub(leave[i], at)), near), unit));
    }
    return hn::Le(ends, unit);
  }

  // CrossingGroup for the lanes of `crowd`: those in which it is not certain, and those in which its faces cancel,
  // whose state is then that behind it.
  // @param ends  told of all of these lanes: CoincidentEnds
  HWY_NOINLINE void MeetGroup(D d, std::uint32_t count, hn::Vec<D> at, hn::Vec<D> near, hn::Vec<D> together,
                              hn::Mask<D> crowd, hn::Vec<U> table, hn::Vec<U> start, hn::Vec<U>& state,
                              hn::Vec<D>* next, hn::Mask<D>& cancels, hn::Mask<D>& doubtful, hn::Vec<U>& ends) const {
    const U u;
    doubtful = hn::Lt(near, hn::Zero(d));
    auto after = state;
    ends = hn::Zero(u);
    hn::Mask<D> entered[Cell::most_tabled], left[Cell::most_tabled];
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto from_enter = hn::Abs(hn::Sub(enter[i], at)), from_leave = hn::Abs(hn::Sub(leave[i], at));
      entered[i] = hn::Le(from_enter, together);
      left[i] = hn::Le(from_leave, together);
      doubtful = hn::Or(doubtful, hn::AndNot(entered[i], hn::Le(from_enter, near)));
      doubtful = hn::Or(doubtful, hn::AndNot(left[i], hn::Le(from_leave, near)));
      const auto bit = hn::Set(u, std::uint64_t{1} << i);
      after = hn::IfThenElse(hn::RebindMask(u, entered[i]), hn::Or(after, bit), after);
      after = hn::IfThenElse(hn::RebindMask(u, left[i]), hn::AndNot(bit, after), after);
      const auto left_bit = hn::Set(u, std::uint64_t{1} << (i + CoincidentEnds::left_shift));
      ends = hn::Or(ends, hn::IfThenElseZero(hn::RebindMask(u, entered[i]), bit));
      ends = hn::Or(ends, hn::IfThenElseZero(hn::RebindMask(u, left[i]), left_bit));
    }
    ends = hn::Or(ends, hn::ShiftLeft<CoincidentEnds::after_shift>(after));
    doubtful = hn::And(doubtful, crowd);
    const auto value = hn::And(hn::Shr(table, after), hn::Set(u, 1));
    cancels = hn::AndNot(doubtful, hn::And(crowd, hn::RebindMask(d, hn::Eq(value, start))));
    state = hn::IfThenElse(hn::RebindMask(u, cancels), after, state);
    for (std::uint32_t i = 0; i < count; ++i) {
      next[i] = hn::IfThenElse(hn::And(cancels, entered[i]), leave[i], next[i]);
      next[i] = hn::IfThenElse(hn::And(cancels, left[i]), hn::Set(d, never), next[i]);
    }
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
