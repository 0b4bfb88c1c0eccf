// One ray at a time through the cells. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_SINGLE_TRACER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_SINGLE_TRACER_INL_H_
#undef TENON_ACCEL_CELLS_SINGLE_TRACER_INL_H_
#else
#define TENON_ACCEL_CELLS_SINGLE_TRACER_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>

#include "accel/cells/exact_cell-inl.h"
#include "accel/cells/node_stack-inl.h"
#include "accel/cells/record_chord-inl.h"
#include "accel/cells/successive_cell-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// The truth table by which the first boundary is found of a ray that comes into a cell of several media in a state.
/// @param value  of the points there
HWY_NOINLINE inline std::uint64_t TableFrom(const CellTree& cells, const Cell& cell, std::uint32_t state,
                                            std::uint8_t& value) {
  const ValueTable values = cells.values_of(cell);
  value = static_cast<std::uint8_t>(values.value(state));
  return values.states(value);
}

/// Follows rays ray by ray.
class SingleTracer {
 public:
  SingleTracer(const CellTree& cells, const CsgTree& tree, CellScratch& scratch, Wanted wanted)
      : cells_(cells), exact_(cells, tree, asked_, scratch), wanted_(wanted) {}

  /// @param answer  as it is made
  HWY_INLINE void Trace(const RayQuery& query, CellAnswer& answer, TraversalCounters& counters) {
    const double square = dot(query.ray.direction, query.ray.direction);
    if (BoxRay ray; !IsSound(query.ray, square)) {
      answer.kind = CellAnswer::Kind::unsure;
    } else if (Begin(query, square, 0, query.t_max, ray)) {
      Walk(ray, answer, counters);
    }
  }

  /// The same for one of the batch, of which some crossings may be known.
  void TraceOfBatch(const RayQuery& query, std::size_t i, CellAnswer& answer, TraversalCounters& counters) {
    exact_.BeginOfBatch(i);
    Trace(query, answer, counters);
    exact_.BeginOfBatch(ExactCell::no_batch);
  }

  /// Follows a ray through a part of the frame of an instance. What is not certain of the part by itself is left to who
  /// asks.
  /// @param query        the ray in that frame; its t_max is infinite
  /// @param local        the same, with its errors
  /// @param begin        where it begins; what lies before from, or behind until, does not count
  void TraceWithin(const RayQuery& query, const LocalRay& local, double begin, double from, double until,
                   CellAnswer& answer, TraversalCounters& counters) {
    asked_.local = &local;
    asked_.begin = begin;
    const double square = dot(query.ray.direction, query.ray.direction);
    if (BoxRay ray; !IsSound(query.ray, square)) {
      answer.kind = CellAnswer::Kind::unsure;
    } else if (Begin(query, square, from, until, ray)) {
      Walk(ray, answer, counters);
      if (answer.kind == CellAnswer::Kind::boundary && answer.t > until) answer.kind = CellAnswer::Kind::nothing;
    }
  }

  /// Follows a ray through all its boundaries, the nearest first. See trace_all().
  bool TraceAll(const RayQuery& query, TellBoundary tell, TraversalCounters& counters) {
    const double square = dot(query.ray.direction, query.ray.direction);
    if (!IsSound(query.ray, square)) return false;
    BoxRay ray;
    return !Begin(query, square, 0, query.t_max, ray) || WalkOn(ray, tell, counters);
  }

  /// What a boundary amounts to that plain arithmetic found: its t, its leaf and whether the ray enters that are known.
  /// The ray is the one that was begun last.
  HWY_INLINE void Finish(CellAnswer& answer) {
    const double t_max = asked_.query->t_max;
    answer.kind = CellAnswer::Kind::boundary;
    const bool at_end = std::fabs(answer.t - t_max) <= 2 * asked_.near;
    if ((wanted_ != Wanted::occlusion || at_end) && !exact_.Finish(answer)) {
      answer.kind = CellAnswer::Kind::unsure;
    } else if (!(answer.t < t_max)) {
      answer.kind = CellAnswer::Kind::nothing;
    }
  }

  /// Begins a ray that is not traced here, for Finish().
  void BeginKnown(const RayQuery& query) { BeginScale(query, dot(query.ray.direction, query.ray.direction)); }

  /// The same where several faces are known to coincide, about where and in which cell. Begins the ray.
  void FinishGroup(const RayQuery& query, CellAnswer& answer) {
    Outcome outcome = Outcome::unsure;
    if (BoxRay ray; Begin(query, dot(query.ray.direction, query.ray.direction), 0, query.t_max, ray)) {
      const double t = answer.t - start_;
      outcome = Meet(cells_.cells[answer.cell], std::max(t - 2 * asked_.near, 0.0), t + 2 * asked_.near, answer);
    }
    if (outcome != Outcome::met) answer.kind = CellAnswer::Kind::unsure;
  }

 private:
  friend class SuccessiveCell<SingleTracer>;
  using Axes = hn::CappedTag<double, 4>;
  static constexpr double never = std::numeric_limits<double>::infinity();

  // Whether single precision and the records can follow a ray; false for what is not a number, too.
  HWY_INLINE bool IsSound(const Ray& ray, double square) const {
    bool is_near = true;
    for (std::size_t a = 0; a < 4; a += hn::MaxLanes(Axes())) {
      const auto distance = hn::Abs(hn::LoadU(Axes(), &ray.origin.x + a));
      const auto far = hn::Not(hn::Le(distance, hn::Set(Axes(), cells_.scale.far_origin)));
      is_near &= hn::AllFalse(Axes(), hn::And(far, hn::FirstN(Axes(), 3 - a)));
    }
    return is_near && square >= cells_.scale.least_square && square <= CellScale::most_square;
  }

  // Where a part of the line is in the scene's box, all axes at once where a vector has room for them.
  HWY_INLINE bool Begin(const RayQuery& query, double square, double from_t, double until, BoxRay& box_ray) {
    const Axes axes;
    const hn::Rebind<float, Axes> floats;
    BeginScale(query, square);
    const double* const o = &query.ray.origin.x;
    const double* const d = &query.ray.direction.x;
    const auto most = hn::Set(axes, cells_.scale.most_inverse);
    const auto least = hn::Set(axes, cells_.records.least_slope * asked_.length);
    HWY_ALIGN double slowness[4];
    HWY_ALIGN double from[4];
    HWY_ALIGN float box_inverse[4];
    HWY_ALIGN float box_shift[4];
    std::uint32_t flat = 0, backward = 0;
    auto first = hn::Set(axes, from_t), last = hn::Set(axes, until);
    for (std::size_t a = 0; a < 4; a += hn::MaxLanes(axes)) {
      // What stands in the fourth place is no axis.
      const auto is_axis = hn::FirstN(axes, 3 - a);
      const auto origin = hn::LoadU(axes, o + a), direction = hn::LoadU(axes, d + a);
      const auto inverse = hn::Max(hn::Min(hn::Div(hn::Set(axes, 1.0), direction), most), hn::Neg(most));
      const auto to_low = hn::Mul(hn::Sub(hn::Load(axes, &cells_.frame.low[a]), origin), inverse);
      const auto to_high = hn::Mul(hn::Sub(hn::Load(axes, &cells_.frame.high[a]), origin), inverse);
      first = hn::IfThenElse(is_axis, hn::Max(first, hn::Min(to_low, to_high)), first);
      last = hn::IfThenElse(is_axis, hn::Min(last, hn::Max(to_low, to_high)), last);
      hn::Store(inverse, axes, slowness + a);
      flat |= MaskOf(axes, hn::Le(hn::Abs(direction), least)) << a;
      backward |= MaskOf(axes, hn::Lt(inverse, hn::Zero(axes))) << a;
    }
    const double near = hn::GetLane(hn::MaxOfLanes(axes, first)), far = hn::GetLane(hn::MinOfLanes(axes, last));
    if (!(near <= far)) return false;
    start_ = near;
    for (std::size_t a = 0; a < 4; a += hn::MaxLanes(axes)) {
      const auto to_center = hn::Sub(hn::LoadU(axes, o + a), hn::Load(axes, &cells_.frame.center[a]));
      const auto place = hn::Add(to_center, hn::Mul(hn::Set(axes, near), hn::LoadU(axes, d + a)));
      const auto inverse = hn::DemoteTo(floats, hn::Load(axes, slowness + a));
      hn::Store(place, axes, from + a);
      hn::Store(inverse, floats, box_inverse + a);
      hn::Store(hn::Mul(hn::DemoteTo(floats, place), inverse), floats, box_shift + a);
    }
    // Rounded up; the slack of the boxes covers half an ulp, not what lies behind t_max.
    box_ray = BoxRay(box_shift, box_inverse, static_cast<float>((far - near) * (1 + 0x1p-20)), backward & 7);
    ray_.origin = {from[0], from[1], from[2]};
    ray_.direction = {d[0], d[1], d[2]};
    ray_.slowness = {slowness[0], slowness[1], slowness[2]};
    ray_.inverse_square = asked_.inverse_square;
    ray_.length = asked_.length;
    ray_.near = asked_.near;
    ray_.flat = (flat & 7) != 0;
    return true;
  }

  template <class Lanes>
  static HWY_INLINE std::uint32_t MaskOf(Lanes d, hn::Mask<Lanes> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
  }

  HWY_INLINE void BeginScale(const RayQuery& query, double square) {
    asked_.Begin(query, square, cells_.scale);
    exact_.Begin();
  }

  HWY_INLINE void Walk(const BoxRay& ray, CellAnswer& answer, TraversalCounters& counters) {
    NodeStack stack;
    std::uint64_t visited = 0;
    tests_ = 0;
    counters_ = &counters;
    NodeStack::Visit visit{ChildRef::node(0), 0, 0};
    for (;;) {
      if (!visit.child.is_cell()) {
        if (stack.OpenNearest(cells_.nodes[visit.child.index()], ray, visit)) continue;
      } else {
        ++visited;
        const Cell& cell = cells_.cells[visit.child.index()];
        answer.cell = visit.child.index();
        const Outcome outcome = cell.leaf_count == 1 ? MeetLeaf(cell, visit.t_in, visit.t_out, answer)
                                                     : Meet(cell, visit.t_in, visit.t_out, answer);
        if (outcome == Outcome::unsure) answer.kind = CellAnswer::Kind::unsure;
        if (outcome != Outcome::passed) break;
      }
      if (stack.empty()) break;
      visit = stack.Pop();
    }
    counters.cells_visited += visited;
    counters.primitive_tests += tests_ + exact_.TakeTests();
  }

  // Walk() for all boundaries.
  bool WalkOn(const BoxRay& ray, TellBoundary tell, TraversalCounters& counters) {
    NodeStack stack;
    stack.Open(cells_.nodes.front(), ray);
    std::uint64_t visited = 0;
    tests_ = 0;
    counters_ = &counters;
    passed_ = -std::numeric_limits<double>::infinity();
    resolved_ = false;
    Outcome outcome = Outcome::passed;
    while (!stack.empty() && outcome == Outcome::passed) {
      const auto [child, t_in, t_out] = stack.Pop();
      if (!child.is_cell()) {
        stack.Open(cells_.nodes[child.index()], ray);
        continue;
      }
      ++visited;
      CellAnswer answer;
      while ((outcome = MeetNext(child.index(), t_in, t_out, answer)) == Outcome::met) {
        if (answer.kind == CellAnswer::Kind::nothing || !tell(answer)) break;
        passed_ = answer.t;
      }
    }
    counters.cells_visited += visited;
    counters.primitive_tests += tests_ + exact_.TakeTests();
    return outcome != Outcome::unsure;
  }

  // The next boundary in a cell behind the one that was passed last. Nothing that plain arithmetic was certain of has
  // another within two resolutions. Whatever else was passed may, and is told from its neighbours by the classifier.
  Outcome MeetNext(std::uint32_t index, double t_in, double t_out, CellAnswer& answer) {
    const Cell& cell = cells_.cells[index];
    answer = CellAnswer{};
    answer.cell = index;
    Outcome outcome = Outcome::passed;
    if (resolved_ && t_in + start_ <= passed_ + 4 * asked_.near) {
      outcome = exact_.Resolve(cell, std::max(t_in + start_, passed_), t_out + start_, answer);
      const bool is_before_end = answer.t < asked_.query->t_max;
      answer.kind = is_before_end ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    } else {
      const double from = std::max(t_in, passed_ + 0.5 * asked_.near - start_);
      if (!(from <= t_out)) return Outcome::passed;
      const bool resolved = std::exchange(resolved_, false);
      outcome = Meet(cell, from, t_out, answer);
      if (outcome == Outcome::passed) resolved_ = resolved;
    }
    if (outcome != Outcome::met) return outcome;
    return answer.kind == CellAnswer::Kind::unsure || !(answer.t > passed_) ? Outcome::unsure : Outcome::met;
  }

  // Finish() for crossings that coincide, behind which the state is `after`.
  HWY_NOINLINE void FinishGroup(const Cell& cell, const CrossingGroup& group, std::uint32_t after, CellAnswer& answer) {
    answer.kind = CellAnswer::Kind::boundary;
    if (wanted_ == Wanted::occlusion && answer.t + 2 * asked_.near < asked_.query->t_max) return;
    if (!exact_.FinishGroup(cell, group, start_, after, wanted_ == Wanted::hit, answer)) {
      const double before = std::max(answer.t - 2 * asked_.near, asked_.begin), behind = answer.t + 2 * asked_.near;
      if (Ask(cell, before, behind, answer) != Outcome::met) {
        answer.kind = CellAnswer::Kind::unsure;
        return;
      }
    }
    if (!(answer.t < asked_.query->t_max)) answer.kind = CellAnswer::Kind::nothing;
  }

  // What the exact arithmetic says of a cell. Here t is that of the query.
  HWY_NOINLINE Outcome Ask(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    Outcome outcome = Outcome::unsure;
    if (!cell.extended) outcome = exact_.Meet(cell, t_in, t_out, wanted_ == Wanted::hit, answer);
    if (outcome == Outcome::unsure && asked_.local == nullptr) {
      outcome = exact_.Resolve(cell, t_in, t_out, answer);
      resolved_ = outcome == Outcome::met;
    }
    return outcome;
  }

  HWY_NOINLINE Outcome MeetExactly(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    const Outcome outcome = Ask(cell, t_in + start_, t_out + start_, answer);
    if (outcome == Outcome::met) {
      answer.kind = answer.t < asked_.query->t_max ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    }
    return outcome;
  }

  // Meet() for what plain arithmetic cannot do by itself.
  HWY_NOINLINE Outcome MeetOtherwise(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    Outcome outcome = Outcome::unsure;
    if (cell.successive && !cell.extended) {
      outcome = cell.leaf_count > 1 ? SuccessiveCell<SingleTracer>(*this, cell, t_in, t_out).Meet(answer)
                : cell.records[0].kind() == RecordKind::mesh
                    ? MeetAlone(mesh_ray(cell, 0), cell, t_in, t_out, answer)
                    : MeetAlone(instance_ray(cell, 0), cell, t_in, t_out, answer);
    }
    return outcome == Outcome::unsure ? MeetExactly(cell, t_in, t_out, answer) : outcome;
  }

  InstanceRay<SingleTracer> instance_ray(const Cell& cell, std::uint32_t place) const {
    return {exact_, *cells_.prototypes[cell.records[place].index()], cell.leaves[place]};
  }

  MeshRay mesh_ray(const Cell& cell, std::uint32_t place) { return {exact_, cell.leaves[place]}; }

  // Meet() for a cell that an instance or a mesh has to itself. All that a boundary of it may be one with are others of
  // its own: no other leaf is near.
  template <class LeafRay>
  Outcome MeetAlone(const LeafRay& ray, const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    const double until = t_out + start_;
    const bool any_will_do = wanted_ == Wanted::occlusion && until + 2 * asked_.near < asked_.query->t_max;
    const Outcome outcome =
        ray.Next(t_in + start_, until, any_will_do ? Wanted::occlusion : Wanted::boundary, answer, *counters_);
    if (outcome != Outcome::met || any_will_do) return outcome;
    TellBoundary((cell.table >> answer.before & 1) != 0, (cell.table >> answer.after & 1) != 0, answer);
    return Outcome::met;
  }

  // The boundary whose crossing, with its last bits, `answer` is already.
  void TellBoundary(bool before, bool after, CellAnswer& answer) const {
    answer.before = before ? 1 : 0;
    answer.after = after ? 1 : 0;
    answer.kind = answer.t < asked_.query->t_max ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
  }

  // Where the ray meets a leaf of a cell, by its place; nowhere, if it misses it. @return whether that is certain
  HWY_INLINE bool FindLeaf(const Cell& cell, std::uint32_t place, double t_in, double t_out, double& enter,
                           double& leave) const {
    const Stretch<One> s =
        FindStretch(One(), ray_, cells_.records, cell.records[place], cells_.scale.reach, t_in, t_out, true);
    if (HWY_UNLIKELY(s.unsure)) return false;
    enter = s.hit ? s.enter : never;
    leave = s.hit ? s.leave : never;
    const bool starts = t_in + start_ - asked_.begin <= asked_.near;
    return HWY_LIKELY(!starts) || ClearStart(*asked_.query, cell, place, asked_.near, cells_.records, enter, leave);
  }

  // Meet() for a cell of one leaf: where the ray crosses that, the value changes. No other crossing is near, for an
  // interval that is certain is longer.
  HWY_INLINE Outcome MeetLeaf(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    ++tests_;
    double enter, leave;
    if (!FindLeaf(cell, 0, t_in, t_out, enter, leave)) return MeetOtherwise(cell, t_in, t_out, answer);
    const bool inside = enter <= t_in;
    const double t = inside ? leave : enter;
    if (!(t > t_in && t <= t_out)) return Outcome::passed;
    answer.before = static_cast<std::uint8_t>(cell.table >> (inside ? 1 : 0) & 1);
    answer.after = answer.before ^ 1;
    answer.t = t + start_;
    answer.leaf_entering = !inside;
    answer.surface = {cell.leaves[0], 0};
    Finish(answer);
    return Outcome::met;
  }

  // Here t is counted from where the ray meets the scene.
  HWY_NOINLINE Outcome Meet(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    if (cell.extended || cell.general) return MeetOtherwise(cell, t_in, t_out, answer);
    double enter[Cell::most_tabled], leave[Cell::most_tabled], next[Cell::most_tabled];
    std::uint32_t state = 0, first = 0;
    double t = never;  // of the next crossing, the first of those at that double being `first`
    const std::uint32_t count = cell.leaf_count;
    tests_ += count;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (!FindLeaf(cell, i, t_in, t_out, enter[i], leave[i])) return MeetExactly(cell, t_in, t_out, answer);
      const bool inside = enter[i] <= t_in && t_in < leave[i];
      state |= static_cast<std::uint32_t>(inside) << i;
      next[i] = inside ? leave[i] : enter[i] > t_in ? enter[i] : never;
      first = next[i] < t ? i : first;
      t = next[i] < t ? next[i] : t;
    }
    if (!(t <= t_out)) return Outcome::passed;
    const bool has_several = cell.values == Cell::Values::several;
    const std::uint64_t table = HWY_UNLIKELY(has_several) ? TableFrom(cells_, cell, state, answer.before) : cell.table;
    const std::uint64_t before = table >> state & 1;
    const auto find_next = [&] {
      t = never;
      for (std::uint32_t i = 0; i < count; ++i) {
        first = next[i] < t ? i : first;
        t = next[i] < t ? next[i] : t;
      }
    };
    for (; t <= t_out; find_next()) {
      // Crossings at the same double are one step: a change that is undone there is none.
      for (std::uint32_t i = 0; i < count; ++i) {
        if (next[i] != t) continue;
        state ^= 1U << i;
        next[i] = (state >> i & 1) != 0 ? leave[i] : never;
      }
      if ((table >> state & 1) == before) continue;
      std::uint32_t ends = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        ends += static_cast<std::uint32_t>(std::fabs(enter[i] - t) <= asked_.near);
        ends += static_cast<std::uint32_t>(std::fabs(leave[i] - t) <= asked_.near);
      }
      if (ends > 1) {
        CrossingGroup group;
        if (!group.collect(count, enter, leave, t, asked_.near, asked_.together)) {
          return MeetExactly(cell, t_in, t_out, answer);
        }
        const std::uint32_t after = group.after(state);
        if ((table >> after & 1) != before) {
          answer.t = t + start_;
          FinishGroup(cell, group, after, answer);
          return Outcome::met;
        }
        group.skip(leave, next);
        state = after;
        continue;
      }
      answer.t = t + start_;
      answer.leaf_entering = (state >> first & 1) != 0;
      if (HWY_UNLIKELY(has_several)) {
        answer.after = static_cast<std::uint8_t>(cells_.values_of(cell).value(state));
      } else {
        answer.before = static_cast<std::uint8_t>(before);
        answer.after = static_cast<std::uint8_t>(before ^ 1);
      }
      answer.surface = {cell.leaves[first], 0};
      Finish(answer);
      return Outcome::met;
    }
    return Outcome::passed;
  }

 public:
  /// Gives a leaf's ends at the start of a ray their place: of a leaf nothing but the face that the ray starts on may
  /// lie there, and that is met at exactly 0. Here t is that of the query.
  static bool ClearStart(const RayQuery& query, const Cell& cell, std::uint32_t place, double near,
                         const LeafRecords& records, double& enter, double& leave) {
    const bool enters_here = std::fabs(enter) <= near, leaves_here = std::fabs(leave) <= near;
    if (query.from == nullptr) return !enters_here && !leaves_here;
    const int on_face = start_face(query, cell.leaves[place]);
    if (on_face < 0) return !enters_here && !leaves_here;
    if (enters_here == leaves_here) return false;
    if (!records.start_is_certain(cell.records[place], on_face, query.ray.direction)) return false;
    (enters_here ? enter : leave) = 0;
    return true;
  }

 private:
  const CellTree& cells_;
  AskedRay asked_;
  ExactCell exact_;
  const Wanted wanted_;
  double start_;
  double passed_;  // the boundary that was passed last
  bool resolved_;  // the classifier found it
  SceneRays<One> ray_;
  std::uint64_t tests_;
  TraversalCounters* counters_;  // of the ray that is followed
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
