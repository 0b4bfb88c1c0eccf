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

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether single precision and the records can follow a ray; false for what is not a number, too.
inline bool IsSound(const CellTree& cells, const Vec3& origin, double square) {
  return max_component(abs(origin)) <= cells.scale.far_origin && square >= 0x1p-200 && square <= 0x1p200;
}

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
      : cells_(cells), exact_(cells, tree, scratch), wanted_(wanted), tolerance_(tree.tolerance.distance) {}

  /// @param answer  as it is made
  void Trace(const RayQuery& query, CellAnswer& answer, TraversalCounters& counters) {
    query_ = &query;
    const double square = dot(query.ray.direction, query.ray.direction);
    if (!IsSound(cells_, query.ray.origin, square)) {
      answer.kind = CellAnswer::Kind::unsure;
    } else if (Begin(square)) {
      Walk(answer, counters);
    }
  }

  /// Follows a ray through all its boundaries, the nearest first. See trace_all().
  bool TraceAll(const RayQuery& query, TellBoundary tell, TraversalCounters& counters) {
    query_ = &query;
    const double square = dot(query.ray.direction, query.ray.direction);
    if (!IsSound(cells_, query.ray.origin, square)) return false;
    return !Begin(square) || WalkOn(tell, counters);
  }

  /// What a boundary amounts to that plain arithmetic found: its t, its leaf and whether the ray enters that are known.
  /// The ray is the one that was begun last.
  void Finish(CellAnswer& answer) {
    answer.kind = CellAnswer::Kind::boundary;
    const bool at_end = std::fabs(answer.t - query_->t_max) <= 2 * near_;
    if (wanted_ != Wanted::occlusion || at_end) {
      NeedExact();
      if (!exact_.Finish(answer)) {
        answer.kind = CellAnswer::Kind::unsure;
        return;
      }
    }
    if (!(answer.t < query_->t_max)) answer.kind = CellAnswer::Kind::nothing;
  }

  /// Begins a ray that is not traced here, for Finish().
  void BeginKnown(const RayQuery& query) {
    query_ = &query;
    BeginScale(dot(query.ray.direction, query.ray.direction));
  }

  /// The same where several faces are known to coincide, about where and in which cell. Begins the ray.
  void FinishGroup(const RayQuery& query, CellAnswer& answer) {
    query_ = &query;
    Outcome outcome = Outcome::unsure;
    if (Begin(dot(query.ray.direction, query.ray.direction))) {
      const double t = answer.t - start_;
      outcome = Meet(cells_.cells[answer.cell], std::max(t - 2 * near_, 0.0), t + 2 * near_, answer);
    }
    if (outcome != Outcome::met) answer.kind = CellAnswer::Kind::unsure;
  }

 private:
  // Where the line is in the scene's box, all axes at once where a vector has room for them; of what stands in the
  // fourth place nothing is asked.
  bool Begin(double square) {
    using Axes = hn::CappedTag<double, 4>;
    const Axes axes;
    const hn::Rebind<float, Axes> floats;
    BeginScale(square);
    const double* const o = &query_->ray.origin.x;
    const double* const d = &query_->ray.direction.x;
    const auto most = hn::Set(axes, 0x1p100);
    const auto least = hn::Set(axes, cells_.records.least_slope * scale_.length);
    HWY_ALIGN double in[4];
    HWY_ALIGN double out[4];
    HWY_ALIGN double slowness[4];
    HWY_ALIGN double from[4];
    std::uint32_t flat = 0, backward = 0;
    for (std::size_t a = 0; a < 4; a += hn::MaxLanes(axes)) {
      const auto origin = hn::LoadU(axes, o + a), direction = hn::LoadU(axes, d + a);
      const auto inverse = hn::Max(hn::Min(hn::Div(hn::Set(axes, 1.0), direction), most), hn::Neg(most));
      const auto to_low = hn::Mul(hn::Sub(hn::Load(axes, &cells_.frame.low[a]), origin), inverse);
      const auto to_high = hn::Mul(hn::Sub(hn::Load(axes, &cells_.frame.high[a]), origin), inverse);
      hn::Store(hn::Min(to_low, to_high), axes, in + a);
      hn::Store(hn::Max(to_low, to_high), axes, out + a);
      hn::Store(inverse, axes, slowness + a);
      hn::Store(hn::DemoteTo(floats, inverse), floats, inverse_ + a);
      flat |= MaskOf(axes, hn::Le(hn::Abs(direction), least)) << a;
      backward |= MaskOf(axes, hn::Lt(inverse, hn::Zero(axes))) << a;
    }
    const double near = std::max({0.0, in[0], in[1], in[2]}), far = std::min({query_->t_max, out[0], out[1], out[2]});
    if (!(near <= far)) return false;
    start_ = near;
    octant_ = backward & 7;
    // Rounded up; the slack of the boxes covers half an ulp, not what lies behind t_max.
    t_end_ = static_cast<float>((far - near) * (1 + 0x1p-20));
    for (std::size_t a = 0; a < 4; a += hn::MaxLanes(axes)) {
      const auto to_center = hn::Sub(hn::LoadU(axes, o + a), hn::Load(axes, &cells_.frame.center[a]));
      const auto place = hn::Add(to_center, hn::Mul(hn::Set(axes, near), hn::LoadU(axes, d + a)));
      hn::Store(place, axes, from + a);
      hn::Store(hn::DemoteTo(floats, place), floats, origin_ + a);
    }
    const One one;
    ray_.origin = {hn::Set(one, from[0]), hn::Set(one, from[1]), hn::Set(one, from[2])};
    ray_.direction = {hn::Set(one, d[0]), hn::Set(one, d[1]), hn::Set(one, d[2])};
    ray_.slowness = {hn::Set(one, slowness[0]), hn::Set(one, slowness[1]), hn::Set(one, slowness[2])};
    ray_.inverse_square = hn::Set(one, scale_.inverse_square);
    ray_.length = hn::Set(one, scale_.length);
    ray_.near = hn::Set(one, near_);
    ray_.flat = (flat & 7) != 0;
    return true;
  }

  template <class Lanes>
  static HWY_INLINE std::uint32_t MaskOf(Lanes d, hn::Mask<Lanes> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
  }

  void BeginScale(double square) {
    scale_ = {square, 1 / square, std::sqrt(square)};
    const double slowness = 1 / scale_.length;
    near_ = 2 * cells_.scale.resolution * slowness;
    together_ = tolerance_ * slowness;
    exact_begun_ = false;
  }

  void Walk(CellAnswer& answer, TraversalCounters& counters) {
    NodeStack stack;
    const BoxRay ray{
        {&origin_[0], &origin_[1], &origin_[2]}, {&inverse_[0], &inverse_[1], &inverse_[2]}, t_end_, octant_};
    std::uint64_t visited = 0;
    tests_ = 0;
    NodeStack::Visit visit{ChildRef::node(0), 0, 0};
    for (;;) {
      if (!visit.child.is_cell()) {
        if (stack.OpenNearest(cells_.nodes[visit.child.index()], ray, visit)) continue;
      } else {
        ++visited;
        const Cell& cell = cells_.cells[visit.child.index()];
        answer.cell = visit.child.index();
        const Outcome outcome = Meet(cell, visit.t_in, visit.t_out, answer);
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
  bool WalkOn(TellBoundary tell, TraversalCounters& counters) {
    NodeStack stack;
    const BoxRay ray{
        {&origin_[0], &origin_[1], &origin_[2]}, {&inverse_[0], &inverse_[1], &inverse_[2]}, t_end_, octant_};
    stack.Open(cells_.nodes.front(), ray);
    tests_ = 0;
    passed_ = -std::numeric_limits<double>::infinity();
    resolved_ = false;
    Outcome outcome = Outcome::passed;
    while (!stack.empty() && outcome == Outcome::passed) {
      const auto [child, t_in, t_out] = stack.Pop();
      if (!child.is_cell()) {
        stack.Open(cells_.nodes[child.index()], ray);
        continue;
      }
      ++counters.cells_visited;
      CellAnswer answer;
      while ((outcome = MeetNext(child.index(), t_in, t_out, answer)) == Outcome::met) {
        if (answer.kind == CellAnswer::Kind::nothing || !tell(answer)) break;
        passed_ = answer.t;
      }
    }
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
    if (resolved_ && t_in + start_ <= passed_ + 4 * near_) {
      NeedExact();
      outcome = exact_.Resolve(cell, std::max(t_in + start_, passed_), t_out + start_, answer);
      const bool is_before_end = answer.t < query_->t_max;
      answer.kind = is_before_end ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    } else {
      const double from = std::max(t_in, passed_ + 0.5 * near_ - start_);
      if (!(from <= t_out)) return Outcome::passed;
      const bool resolved = std::exchange(resolved_, false);
      outcome = Meet(cell, from, t_out, answer);
      if (outcome == Outcome::passed) resolved_ = resolved;
    }
    if (outcome != Outcome::met) return outcome;
    return answer.kind == CellAnswer::Kind::unsure || !(answer.t > passed_) ? Outcome::unsure : Outcome::met;
  }

  void NeedExact() {
    if (exact_begun_) return;
    exact_.Begin(*query_, scale_, 0.5 * near_, together_);
    exact_begun_ = true;
  }

  // Finish() for crossings that coincide, behind which the state is `after`.
  HWY_NOINLINE void FinishGroup(const Cell& cell, const CrossingGroup& group, std::uint32_t after, CellAnswer& answer) {
    answer.kind = CellAnswer::Kind::boundary;
    if (wanted_ == Wanted::occlusion && answer.t + 2 * near_ < query_->t_max) return;
    NeedExact();
    if (!exact_.FinishGroup(cell, group, start_, after, wanted_ == Wanted::hit, answer)) {
      const double before = std::max(answer.t - 2 * near_, 0.0), behind = answer.t + 2 * near_;
      if (Ask(cell, before, behind, answer) != Outcome::met) {
        answer.kind = CellAnswer::Kind::unsure;
        return;
      }
    }
    if (!(answer.t < query_->t_max)) answer.kind = CellAnswer::Kind::nothing;
  }

  // What the exact arithmetic says of a cell. Here t is that of the query.
  HWY_NOINLINE Outcome Ask(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    Outcome outcome = Outcome::unsure;
    if (!cell.extended) outcome = exact_.Meet(cell, t_in, t_out, wanted_ == Wanted::hit, answer);
    if (outcome == Outcome::unsure) {
      outcome = exact_.Resolve(cell, t_in, t_out, answer);
      resolved_ = outcome == Outcome::met;
    }
    return outcome;
  }

  HWY_NOINLINE Outcome MeetExactly(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    NeedExact();
    const Outcome outcome = Ask(cell, t_in + start_, t_out + start_, answer);
    if (outcome == Outcome::met) {
      answer.kind = answer.t < query_->t_max ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    }
    return outcome;
  }

  // Here t is counted from where the ray meets the scene.
  HWY_INLINE Outcome Meet(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    if (cell.extended || cell.general) return MeetExactly(cell, t_in, t_out, answer);
    // A leaf that the ray misses is crossed nowhere.
    constexpr double never = std::numeric_limits<double>::infinity();
    double enter[Cell::most_tabled], leave[Cell::most_tabled], next[Cell::most_tabled];
    const One one;
    const auto all = hn::Eq(hn::Zero(one), hn::Zero(one));
    std::uint32_t state = 0;
    const std::uint32_t count = cell.leaf_count;
    tests_ += count;
    const bool starts = t_in + start_ <= near_;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Stretch<One> s = FindStretch(one, ray_, cells_.records, cell.records[i], cells_.scale.reach,
                                         hn::Set(one, t_in), hn::Set(one, t_out), all);
      if (HWY_UNLIKELY(!hn::AllFalse(one, s.unsure))) return MeetExactly(cell, t_in, t_out, answer);
      const bool hit = !hn::AllFalse(one, s.hit);
      enter[i] = hit ? hn::GetLane(s.enter) : never;
      leave[i] = hit ? hn::GetLane(s.leave) : never;
      if (starts && !ClearStart(*query_, cell, i, near_, cells_.records, enter[i], leave[i])) {
        return MeetExactly(cell, t_in, t_out, answer);
      }
      const bool inside = enter[i] <= t_in && t_in < leave[i];
      state |= static_cast<std::uint32_t>(inside) << i;
      next[i] = inside ? leave[i] : enter[i] > t_in ? enter[i] : never;
    }
    const bool has_several = cell.values == Cell::Values::several;
    const std::uint64_t table = HWY_UNLIKELY(has_several) ? TableFrom(cells_, cell, state, answer.before) : cell.table;
    const std::uint64_t before = table >> state & 1;
    for (;;) {
      std::uint32_t first = 0;
      double t = next[0];
      for (std::uint32_t i = 1; i < count; ++i) {
        first = next[i] < t ? i : first;
        t = next[i] < t ? next[i] : t;
      }
      if (!(t <= t_out)) return Outcome::passed;
      // Crossings at the same double are one step: a change that is undone there is none.
      for (std::uint32_t i = 0; i < count; ++i) {
        if (next[i] != t) continue;
        state ^= 1U << i;
        next[i] = (state >> i & 1) != 0 ? leave[i] : never;
      }
      if ((table >> state & 1) == before) continue;
      std::uint32_t ends = 0;
      for (std::uint32_t i = 0; i < count; ++i) {
        ends += static_cast<std::uint32_t>(std::fabs(enter[i] - t) <= near_);
        ends += static_cast<std::uint32_t>(std::fabs(leave[i] - t) <= near_);
      }
      if (ends > 1) {
        CrossingGroup group;
        if (!group.collect(count, enter, leave, t, near_, together_)) return MeetExactly(cell, t_in, t_out, answer);
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
    if (on_face == 0 && !records.start_is_certain(cell.records[place], query.ray.direction)) return false;
    (enters_here ? enter : leave) = 0;
    return true;
  }

 private:
  const CellTree& cells_;
  ExactCell exact_;
  const Wanted wanted_;
  const double tolerance_;
  const RayQuery* query_ = nullptr;
  double start_ = 0;
  double near_ = 0;
  double together_ = 0;
  RayScale scale_;
  bool exact_begun_ = false;
  double passed_ = 0;      // the boundary that was passed last
  bool resolved_ = false;  // the classifier found it
  HWY_ALIGN float origin_[4] = {};
  HWY_ALIGN float inverse_[4] = {};
  std::uint32_t octant_ = 0;  // bit a: backward along axis a
  float t_end_ = 0;
  SceneRays<One> ray_;
  std::uint64_t tests_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
