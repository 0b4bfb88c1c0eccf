// Many rays that go much the same way, through the cells together. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_
#undef TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_
#else
#define TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>

#include "accel/cells/block_rays-inl.h"
#include "accel/cells/single_tracer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Follows up to 64 rays into one octant. Nodes are opened for all of them at once, by intervals that hold their
/// origins and directions (Wald et al. 2007, "Ray tracing deformable scenes using dynamic bounding volume hierarchies":
/// frustum culling by interval arithmetic); what is left are the cells that some of them may meet.
class BlockTracer {
 public:
  static constexpr std::size_t most_rays = BlockRays::most_rays;

  explicit BlockTracer(const CellTree& cells, double tolerance) : cells_(cells), tolerance_(tolerance) {}

  /// Takes the rays; false when they do not make a block.
  bool Begin(std::span<const RayQuery> queries) { return rays_.Begin(cells_, queries); }

  /// Traces them; `finisher` gives what was found by plain arithmetic its last bits, and traces the rays that are left
  /// when the block is given up.
  /// @return whether the block was worth its while
  bool Trace(std::span<CellAnswer> answers, SingleTracer& finisher, TraversalStatistics& statistics) {
    any_will_do_ = finisher.wanted() == Wanted::occlusion;
    const bool pays = Walk();
    if (!pays) GiveUp();
    TraversalCounters& counters = statistics[rays_.queries[0].kind];
    counters.cells_visited += visited_;
    counters.primitive_tests += tests_;
    std::uint64_t finished = 0;
    if (finisher.wanted() == Wanted::boundary) finished = FinishTogether(answers);
    for (std::size_t i = 0; i < rays_.count; ++i) {
      if ((finished >> i & 1) == 0) Answer(i, answers[i], finisher, counters);
    }
    return pays;
  }

 private:
  using D = BlockRays::D;
  using U = hn::RebindToUnsigned<D>;
  using F = BlockRays::F;
  using HalfF = BlockRays::HalfF;
  static constexpr std::size_t double_lanes = BlockRays::double_lanes, float_lanes = BlockRays::float_lanes;
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  enum Flag : std::uint8_t { entering = 1, was_inside = 2, group = 4 };

  struct Entry {
    std::uint32_t child;
    float key;
    std::array<float, 6> box;  // of a cell: ends nearest to the start by axis, then those furthest
  };

  // Pushes the children that some ray may meet, the nearest last.
  HWY_INLINE void Open(const WideNode& node, Entry*& top) {
    const hn::CappedTag<float, node_width> wide;
    HWY_ALIGN float t_in[node_width];
    std::uint32_t met = 0;
    for (std::size_t lane = 0; lane < node_width; lane += hn::Lanes(wide)) {
      auto near = hn::Zero(wide), far = hn::Set(wide, longest_);
      for (std::size_t a = 0; a < 3; ++a) {
        const bool backward = rays_.backward[a] != 0;
        const auto first = static_cast<std::size_t>(rays_.backward[a]);
        const auto low = hn::Set(wide, rays_.low_inverse[a]), high = hn::Set(wide, rays_.high_inverse[a]);
        // The least product is that with the origin nearest behind the plane, and the greatest the other way round.
        const auto in = hn::Sub(hn::Load(wide, node.ends[a][first].data() + lane),
                                hn::Set(wide, backward ? rays_.low_origin[a] : rays_.high_origin[a]));
        const auto out = hn::Sub(hn::Load(wide, node.ends[a][1 - first].data() + lane),
                                 hn::Set(wide, backward ? rays_.high_origin[a] : rays_.low_origin[a]));
        near = hn::Max(near, hn::Min(hn::Mul(in, low), hn::Mul(in, high)));
        far = hn::Min(far, hn::Max(hn::Mul(out, low), hn::Mul(out, high)));
      }
      hn::Store(near, wide, t_in + lane);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(wide, hn::Le(near, far), bits);
      met |= static_cast<std::uint32_t>(bits[0]) << lane;
    }
    Entry* const first = top;
    for (; met != 0; met &= met - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(met));
      if (node.children[lane].bits == ChildRef{}.bits) continue;
      Entry entry;
      entry.child = node.children[lane].bits;
      entry.key = t_in[lane];
      for (std::size_t a = 0; a < 3; ++a) {
        const auto side = static_cast<std::size_t>(rays_.backward[a]);
        entry.box[a] = node.ends[a][side][lane];
        entry.box[3 + a] = node.ends[a][1 - side][lane];
      }
      Entry* place = top++;
      for (; place != first && place[-1].key < entry.key; --place) *place = place[-1];
      *place = entry;
    }
  }

  // A step of the block costs about what it costs to bring so many rays one cell further one by one. Rays whose ways
  // lie apart share few cells, while the block opens all that lie between them. Both numbers are set by trial on the
  // bench; they decide who traces a ray, never what comes of it.
  static constexpr std::uint64_t least_rays_a_step = 2;
  static constexpr std::uint64_t steps_of_grace = 48;

  // @return false when it was given up, since too few rays share its cells
  bool Walk() {
    const D d;
    for (std::size_t i = 0; i < rays_.padded; i += double_lanes)
      hn::Store(hn::Set(d, std::numeric_limits<double>::infinity()), d, &best_t_[i]);
    std::fill_n(found_, rays_.padded, none);
    unsure_ = visited_ = tests_ = 0;
    if (rays_.all_miss) return true;
    ShortenBlock();
    Entry* const stack = stack_.data();
    Entry* top = stack;
    Open(cells_.nodes.front(), top);
    std::uint64_t steps = 0;
    while (top != stack) {
      const Entry entry = *--top;
      // Every ray has its boundary by then.
      if (entry.key > longest_) continue;
      if (++steps > steps_of_grace && visited_ < least_rays_a_step * (steps - steps_of_grace)) return false;
      const ChildRef child{entry.child};
      if (!child.is_cell()) {
        Open(cells_.nodes[child.index()], top);
        continue;
      }
      if (Visit(child.index(), entry)) ShortenBlock();
    }
    return true;
  }

  // What was found so far need not be the first; where any boundary will do, and one was found for certain, it stands.
  void GiveUp() {
    for (std::size_t i = 0; i < rays_.count; ++i) {
      const bool is_done = rays_.box_end[i] < 0 && (any_will_do_ || found_[i] == none);
      if (!is_done) unsure_ |= std::uint64_t{1} << i;
    }
  }

  void ShortenBlock() {
    const F f;
    auto longest = hn::Load(f, rays_.box_end);
    for (std::size_t i = float_lanes; i < rays_.padded; i += float_lanes)
      longest = hn::Max(longest, hn::Load(f, rays_.box_end + i));
    longest_ = hn::GetLane(hn::MaxOfLanes(f, longest));
  }

  // @return whether some ray became shorter
  bool Visit(std::uint32_t index, const Entry& entry) {
    const F f;
    const HalfF half;
    bool shorter = false;
    for (std::size_t i = 0; i < rays_.padded; i += float_lanes) {
      auto near = hn::Zero(f), far = hn::Load(f, rays_.box_end + i);
      for (std::size_t a = 0; a < 3; ++a) {
        const auto origin = hn::Load(f, &rays_.box_origin[a][i]), inverse = hn::Load(f, &rays_.box_inverse[a][i]);
        near = hn::Max(near, hn::Mul(hn::Sub(hn::Set(f, entry.box[a]), origin), inverse));
        far = hn::Min(far, hn::Mul(hn::Sub(hn::Set(f, entry.box[3 + a]), origin), inverse));
      }
      if (hn::AllFalse(f, hn::Le(near, far))) continue;
      HWY_ALIGN float t_in[float_lanes];
      HWY_ALIGN float t_out[float_lanes];
      hn::Store(near, f, t_in);
      hn::Store(far, f, t_out);
      const D d;
      for (std::size_t k = 0; k < float_lanes; k += double_lanes) {
        const auto in = hn::PromoteTo(d, hn::Load(half, t_in + k)), out = hn::PromoteTo(d, hn::Load(half, t_out + k));
        const auto lanes = hn::Le(in, out);
        if (hn::AllFalse(d, lanes)) continue;
        visited_ += hn::CountTrue(d, lanes);
        shorter |= Meet(index, i + k, lanes, in, out);
      }
    }
    return shorter;
  }

  static std::uint32_t Bits(hn::Mask<D> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), mask, bits);
    return bits[0];
  }

  bool Drop(std::size_t at, std::uint32_t lanes) {
    unsure_ |= static_cast<std::uint64_t>(lanes) << at;
    for (; lanes != 0; lanes &= lanes - 1) rays_.box_end[at + static_cast<std::size_t>(std::countr_zero(lanes))] = -1;
    return true;
  }

  // SingleTracer::Meet for the lanes at `at`; what it has to ask for is left to it.
  bool Meet(std::uint32_t index, std::size_t at, hn::Mask<D> lanes, hn::Vec<D> t_in, hn::Vec<D> t_out) {
    const Cell& cell = cells_.cells[index];
    if (cell.general || cell.extended) return Drop(at, Bits(lanes));
    const D d;
    const U u;
    const SceneRays<D> ray = rays_.At(at);
    const auto never = hn::Set(d, std::numeric_limits<double>::infinity());
    const std::uint32_t count = cell.leaf_count;
    tests_ += count * hn::CountTrue(d, lanes);
    const auto starts = hn::And(lanes, hn::Le(hn::Add(t_in, hn::Load(d, &rays_.start[at])), ray.near));
    const bool any_starts = !hn::AllFalse(d, starts);
    hn::Vec<D> enter[Cell::most_tabled], leave[Cell::most_tabled], next[Cell::most_tabled];
    auto state = hn::Zero(u);
    auto unsure = hn::Lt(ray.near, hn::Zero(d));  // none
    for (std::uint32_t i = 0; i < count; ++i) {
      const Stretch<D> s = FindStretch(d, ray, cells_.records, cell.records[i], cells_.scale.reach, t_in, t_out, lanes);
      enter[i] = hn::IfThenElse(s.hit, s.enter, never);
      leave[i] = hn::IfThenElse(s.hit, s.leave, never);
      unsure = hn::Or(unsure, s.unsure);
      if (any_starts) {
        const auto here = hn::Or(hn::Le(hn::Abs(enter[i]), ray.near), hn::Le(hn::Abs(leave[i]), ray.near));
        unsure = hn::Or(unsure,
                        rays_.has_from ? DoubtStarts(cell, i, at, starts, enter[i], leave[i]) : hn::And(starts, here));
      }
      const auto inside = hn::And(hn::Le(enter[i], t_in), hn::Lt(t_in, leave[i]));
      state = hn::Or(state, hn::IfThenElseZero(hn::RebindMask(u, inside), hn::Set(u, std::uint64_t{1} << i)));
      const auto ahead = hn::IfThenElse(hn::Gt(enter[i], t_in), enter[i], never);
      next[i] = hn::IfThenElse(inside, leave[i], ahead);
    }
    unsure = hn::And(unsure, lanes);
    const auto table = hn::Set(u, cell.table);
    const auto one = hn::Set(u, 1);
    const auto before = hn::And(hn::Shr(table, state), one);
    auto active = hn::AndNot(unsure, lanes);
    auto met = hn::Lt(ray.near, hn::Zero(d)), crowded = met, enters = met;  // none yet
    auto t_met = never;
    auto place = hn::Zero(u);
    for (;;) {
      auto t = next[0];
      for (std::uint32_t i = 1; i < count; ++i) t = hn::Min(t, next[i]);
      active = hn::And(active, hn::Le(t, t_out));
      if (hn::AllFalse(d, active)) break;
      for (std::uint32_t i = count; i-- > 0;) {
        const auto crossed = hn::And(active, hn::Eq(next[i], t));
        const auto leaving = hn::Eq(leave[i], t);
        state = hn::Xor(state, hn::IfThenElseZero(hn::RebindMask(u, crossed), hn::Set(u, std::uint64_t{1} << i)));
        next[i] = hn::IfThenElse(crossed, hn::IfThenElse(leaving, never, leave[i]), next[i]);
        place = hn::IfThenElse(hn::RebindMask(u, crossed), hn::Set(u, i), place);
        enters = hn::Or(hn::AndNot(crossed, enters), hn::AndNot(leaving, crossed));
      }
      const auto value = hn::And(hn::Shr(table, state), one);
      auto changed = hn::AndNot(hn::RebindMask(d, hn::Eq(value, before)), active);
      if (hn::AllFalse(d, changed)) continue;
      if (count > 1) {
        const auto alone = IsAlone(count, enter, leave, t, ray.near);
        const auto crowd = hn::AndNot(alone, changed);
        if (!hn::AllFalse(d, crowd)) {
          hn::Mask<D> cancels, doubtful;
          MeetGroup(count, enter, leave, t, ray, crowd, table, before, state, next, cancels, doubtful);
          unsure = hn::Or(unsure, doubtful);
          changed = hn::AndNot(hn::Or(cancels, doubtful), changed);
          active = hn::AndNot(doubtful, active);
          crowded = hn::Or(crowded, hn::And(crowd, changed));
        }
      }
      t_met = hn::IfThenElse(changed, t, t_met);
      met = hn::Or(met, changed);
      active = hn::AndNot(changed, active);
    }
    bool shorter = false;
    if (HWY_UNLIKELY(!hn::AllFalse(d, unsure))) shorter = Drop(at, Bits(unsure));
    const auto best = hn::Load(d, &best_t_[at]);
    const auto better = hn::And(met, hn::Lt(t_met, best));
    std::uint32_t bits = Bits(better);
    if (bits == 0) return shorter;
    hn::Store(hn::IfThenElse(better, t_met, best), d, &best_t_[at]);
    hn::Store(hn::IfThenElse(hn::RebindMask(u, better), place, hn::Load(u, &place_[at])), u, &place_[at]);
    // Nothing behind the boundary counts; rounded up, for cells whose boxes overlap by the slack.
    const HalfF f;
    const auto end = hn::DemoteTo(f, hn::Mul(t_met, hn::Set(d, 1 + 0x1p-20)));
    HWY_ALIGN float ends[double_lanes];
    hn::Store(end, f, ends);
    const std::uint32_t enter_bits = Bits(enters), crowd_bits = Bits(crowded);
    const std::uint32_t inside_bits = Bits(hn::RebindMask(d, hn::Eq(before, one)));
    for (; bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      found_[at + lane] = index;
      leaf_[at + lane] = cell.leaves[static_cast<std::size_t>(place_[at + lane])];
      const double certain = best_t_[at + lane] + rays_.start[at + lane] + 2 * rays_.near[at + lane];
      const bool is_done = any_will_do_ && certain < rays_.end[at + lane];
      rays_.box_end[at + lane] = is_done ? -1 : std::min(rays_.box_end[at + lane], ends[lane]);
      flags_[at + lane] = static_cast<std::uint8_t>((enter_bits >> lane & 1) | (inside_bits >> lane & 1) << 1 |
                                                    (crowd_bits >> lane & 1) << 2);
    }
    return true;
  }

  static HWY_INLINE hn::Mask<D> IsAlone(std::uint32_t count, const hn::Vec<D>* enter, const hn::Vec<D>* leave,
                                        hn::Vec<D> t, hn::Vec<D> near) {
    const D d;
    const auto unit = hn::Set(d, 1.0);
    auto ends = hn::Zero(d);
    for (std::uint32_t i = 0; i < count; ++i) {
      ends = hn::Add(ends, hn::IfThenElseZero(hn::Le(hn::Abs(hn::Sub(enter[i], t)), near), unit));
      ends = hn::Add(ends, hn::IfThenElseZero(hn::Le(hn::Abs(hn::Sub(leave[i], t)), near), unit));
    }
    return hn::Le(ends, unit);
  }

  // CrossingGroup for the lanes of `crowd`: those in which it is not certain, and those in which its faces cancel,
  // whose state is then that behind it.
  HWY_NOINLINE void MeetGroup(std::uint32_t count, const hn::Vec<D>* enter, const hn::Vec<D>* leave, hn::Vec<D> t,
                              const SceneRays<D>& ray, hn::Mask<D> crowd, hn::Vec<U> table, hn::Vec<U> before,
                              hn::Vec<U>& state, hn::Vec<D>* next, hn::Mask<D>& cancels, hn::Mask<D>& doubtful) {
    const D d;
    const U u;
    const auto together = hn::Mul(ray.near, hn::Set(d, tolerance_ / (2 * cells_.scale.resolution)));
    const auto never = hn::Set(d, std::numeric_limits<double>::infinity());
    doubtful = hn::Lt(ray.near, hn::Zero(d));
    auto after = state;
    hn::Mask<D> entered[Cell::most_tabled], left[Cell::most_tabled];
    for (std::uint32_t i = 0; i < count; ++i) {
      const auto from_enter = hn::Abs(hn::Sub(enter[i], t)), from_leave = hn::Abs(hn::Sub(leave[i], t));
      entered[i] = hn::Le(from_enter, together);
      left[i] = hn::Le(from_leave, together);
      doubtful = hn::Or(doubtful, hn::AndNot(entered[i], hn::Le(from_enter, ray.near)));
      doubtful = hn::Or(doubtful, hn::AndNot(left[i], hn::Le(from_leave, ray.near)));
      const auto bit = hn::Set(u, std::uint64_t{1} << i);
      after = hn::IfThenElse(hn::RebindMask(u, entered[i]), hn::Or(after, bit), after);
      after = hn::IfThenElse(hn::RebindMask(u, left[i]), hn::AndNot(bit, after), after);
    }
    doubtful = hn::And(doubtful, crowd);
    const auto value = hn::And(hn::Shr(table, after), hn::Set(u, 1));
    cancels = hn::AndNot(doubtful, hn::And(crowd, hn::RebindMask(d, hn::Eq(value, before))));
    state = hn::IfThenElse(hn::RebindMask(u, cancels), after, state);
    for (std::uint32_t i = 0; i < count; ++i) {
      next[i] = hn::IfThenElse(hn::And(cancels, entered[i]), leave[i], next[i]);
      next[i] = hn::IfThenElse(hn::And(cancels, left[i]), never, next[i]);
    }
  }

  // The lanes of `starts` in which something other than the face that a ray starts on may lie at its start.
  HWY_NOINLINE hn::Mask<D> DoubtStarts(const Cell& cell, std::uint32_t place, std::size_t at, hn::Mask<D> starts,
                                       hn::Vec<D>& enter, hn::Vec<D>& leave) {
    const D d;
    HWY_ALIGN double enters[double_lanes];
    HWY_ALIGN double leaves[double_lanes];
    HWY_ALIGN double doubts[double_lanes] = {};
    hn::Store(enter, d, enters);
    hn::Store(leave, d, leaves);
    for (std::uint32_t bits = Bits(starts); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      if (at + lane >= rays_.count) continue;
      const bool clear = SingleTracer::ClearStart(rays_.queries[at + lane], cell, place, rays_.near[at + lane],
                                                  cells_.records, enters[lane], leaves[lane]);
      doubts[lane] = clear ? 0 : 1;
    }
    enter = hn::Load(d, enters);
    leave = hn::Load(d, leaves);
    return hn::Gt(hn::Load(d, doubts), hn::Zero(d));
  }

  // SingleTracer::Finish for neighbours that meet the same leaf, and do not start at it.
  // @return the rays whose answers are complete
  std::uint64_t FinishTogether(std::span<CellAnswer> answers) const {
    std::uint64_t finished = 0;
    for (std::size_t at = 0; at < rays_.count; at += double_lanes) {
      std::uint32_t left = 0;
      for (std::size_t lane = 0; lane < double_lanes && at + lane < rays_.count; ++lane) {
        const std::size_t i = at + lane;
        const bool simple = found_[i] != none && (unsure_ >> i & 1) == 0 && (flags_[i] & group) == 0;
        left |= static_cast<std::uint32_t>(simple && rays_.queries[i].from == nullptr) << lane;
      }
      while (left != 0) {
        const LeafId leaf = leaf_[at + static_cast<std::size_t>(std::countr_zero(left))];
        std::uint32_t same = 0;
        for (std::uint32_t bits = left; bits != 0; bits &= bits - 1) {
          const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
          same |= static_cast<std::uint32_t>(leaf_[at + lane] == leaf) << lane;
        }
        left &= ~same;
        finished |= static_cast<std::uint64_t>(FinishLanes(at, leaf, same, answers)) << at;
      }
    }
    return finished;
  }

  std::uint32_t FinishLanes(std::size_t at, LeafId leaf, std::uint32_t lanes, std::span<CellAnswer> answers) const {
    const ShapeRef shape = cells_.shapes.of_leaf[leaf.get()];
    if (shape.kind() == ShapeKind::general) return 0;
    const D d;
    RayLanes<D> ray;
    ray.origin = {hn::Load(d, &rays_.query_origin[0][at]), hn::Load(d, &rays_.query_origin[1][at]),
                  hn::Load(d, &rays_.query_origin[2][at])};
    ray.direction = {hn::Load(d, &rays_.direction[0][at]), hn::Load(d, &rays_.direction[1][at]),
                     hn::Load(d, &rays_.direction[2][at])};
    ray.square = Dot(ray.direction, ray.direction);
    ray.inverse = hn::Div(hn::Set(d, 1.0), ray.square);
    const auto near = hn::Load(d, &rays_.near[at]);
    ray.resolution = hn::Mul(hn::Set(d, 0.5), near);
    const auto chord = FindChord(d, ray, cells_.shapes, shape, -1, cells_.scale.reach, hn::Load(d, &rays_.length[at]));
    HWY_ALIGN double t[2][double_lanes];
    HWY_ALIGN double faces[2][double_lanes];
    hn::Store(chord.leave, d, t[0]);
    hn::Store(chord.enter, d, t[1]);
    hn::Store(chord.leave_face, d, faces[0]);
    hn::Store(chord.enter_face, d, faces[1]);
    std::uint32_t done = 0;
    for (std::uint32_t bits = lanes & Bits(hn::AndNot(chord.unsure, chord.hit)); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const std::size_t i = at + lane;
      const std::size_t end = flags_[i] & entering;
      if (!(std::fabs(t[end][lane] - (best_t_[i] + rays_.start[i])) <= rays_.near[i])) continue;
      CellAnswer& answer = answers[i];
      answer = CellAnswer{};
      answer.t = t[end][lane];
      answer.kind = answer.t < rays_.queries[i].t_max ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
      answer.cell = found_[i];
      answer.surface = {leaf, static_cast<std::uint32_t>(faces[end][lane])};
      answer.leaf_entering = end != 0;
      answer.before = (flags_[i] & was_inside) != 0;
      done |= 1U << lane;
    }
    return done;
  }

  void Answer(std::size_t i, CellAnswer& answer, SingleTracer& single, TraversalCounters& counters) {
    answer = CellAnswer{};
    const RayQuery& query = rays_.queries[i];
    if ((unsure_ >> i & 1) != 0) {
      answer = single.Trace(query, counters);
      return;
    }
    if (found_[i] == none) return;
    const Cell& cell = cells_.cells[found_[i]];
    answer.cell = found_[i];
    answer.t = best_t_[i] + rays_.start[i];
    answer.surface = {leaf_[i], 0};
    answer.leaf_entering = (flags_[i] & entering) != 0;
    answer.before = (flags_[i] & was_inside) != 0;
    if (any_will_do_ && answer.t + 2 * rays_.near[i] < rays_.end[i]) {
      answer.kind = CellAnswer::Kind::boundary;
      return;
    }
    single.BeginKnown(query);
    if ((flags_[i] & group) != 0) {
      single.FinishGroup(cell, answer);
    } else {
      single.Finish(answer);
    }
  }

  const CellTree& cells_;
  const double tolerance_;
  BlockRays rays_;
  bool any_will_do_ = false;
  float longest_ = -1;  // of what is left of the rays

  HWY_ALIGN double best_t_[most_rays];  // counted from the start
  HWY_ALIGN std::uint64_t place_[most_rays];
  std::uint32_t found_[most_rays];
  LeafId leaf_[most_rays];
  std::uint8_t flags_[most_rays];
  std::uint64_t unsure_ = 0;
  std::uint64_t visited_ = 0, tests_ = 0;
  std::array<Entry, most_pending> stack_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
