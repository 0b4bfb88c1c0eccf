// Rays that go different ways, several at once. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_STREAM_TRACER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_STREAM_TRACER_INL_H_
#undef TENON_ACCEL_CELLS_STREAM_TRACER_INL_H_
#else
#define TENON_ACCEL_CELLS_STREAM_TRACER_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>

#include "accel/cells/batch_answers-inl.h"
#include "accel/cells/table_walk-inl.h"
#include "accel/cells/waiting_visits-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Follows some rays of a batch at once, each through nodes of its own, so that none waits for what another has to
/// wait for. When each has come to a cell, the leaves of those cells are met kind by kind, one leaf and ray a lane, and
/// the truth tables are followed, one ray a lane.
class StreamTracer {
 public:
  StreamTracer(const CellTree& cells, RayBatch& rays, BatchFindings& found)
      : cells_(cells), together_to_near_(cells.scale.together_to_near()), rays_(rays), found_(found) {}

  /// Traces rays of the batch.
  /// @param left     them, a bit each
  /// @param waiting  where they are to go; none: through the whole scene
  void Trace(std::uint64_t left, const WaitingVisits* waiting, bool any_will_do, TraversalStatistics& statistics) {
    left_ = left;
    waiting_visits_ = waiting;
    any_will_do_ = any_will_do;
    statistics_ = &statistics;
    slots_open_ = slots_waiting_ = 0;
    for (std::uint8_t slot = 0; slot < most_slots; ++slot) {
      if (Refill(slot)) Advance(slot);
    }
    for (;;) {
      while (slots_open_ != 0) OpenNodes();
      if (slots_waiting_ == 0) break;
      MeetCells();
    }
  }

 private:
  using D = RayBatch::D;
  using U = hn::RebindToUnsigned<D>;
  static constexpr std::size_t double_lanes = RayBatch::double_lanes;
  // Rays under way. By trial on the bench; it decides nothing but how long they take.
  static constexpr std::size_t most_slots = 32;
  static constexpr std::uint32_t kinds = static_cast<std::uint32_t>(RecordKind::revolved) + 1;
  static constexpr ChildRef end_of_stack{~std::uint32_t{0}};

  // A ray under way, and where it is: all that opening a node needs, in one line of the cache.
  struct alignas(64) Slot {
    std::uint32_t ray;
    std::uint32_t index;  // of the node that it opens next, or the cell that it meets
    float t_in, t_out;
    float shift[3], inverse[3], end;  // see BoxRay
    std::uint32_t octant;
  };

  // Begins the next ray in a slot. @return whether there is one
  bool Refill(std::uint8_t slot) {
    if (left_ == 0) return false;
    const auto ray = static_cast<std::uint32_t>(std::countr_zero(left_));
    left_ &= left_ - 1;
    Slot& s = slots_[slot];
    s.ray = ray;
    for (std::size_t a = 0; a < 3; ++a) {
      s.shift[a] = rays_.box_shift[a][ray];
      s.inverse[a] = rays_.box_inverse[a][ray];
    }
    s.end = rays_.box_end[ray];
    s.octant = rays_.octant(ray);
    NodeStack& stack = stacks_[slot];
    stack.Clear();
    stack.Push({end_of_stack, 0, 0});
    if (waiting_visits_ == nullptr) {
      stack.Push({ChildRef::node(0), 0, 0});
    } else {
      for (const NodeStack::Visit& visit : waiting_visits_->of(ray)) stack.Push(visit);
    }
    return true;
  }

  // The next of a slot's stack: a node to open, or a cell to meet; or the slot's next ray.
  HWY_INLINE void Advance(std::uint8_t slot) {
    NodeStack::Visit visit = stacks_[slot].Pop();
    if (visit.child.bits == end_of_stack.bits) {
      if (!Refill(slot)) return;
      visit = stacks_[slot].Pop();
    }
    Slot& s = slots_[slot];
    const bool is_cell = visit.child.is_cell();
    s.index = visit.child.index();
    s.t_in = visit.t_in;
    s.t_out = visit.t_out;
    cells_.prefetch(visit.child);
    open_[slots_open_] = slot;
    slots_open_ += is_cell ? 0 : 1;
    waiting_[slots_waiting_] = slot;
    slots_waiting_ += is_cell ? 1 : 0;
  }

  HWY_NOINLINE void OpenNodes() {
    const std::size_t count = slots_open_;
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint8_t slot = open_[k];
      const Slot& s = slots_[slot];
      stacks_[slot].Open(cells_.nodes[s.index], BoxRay(s.shift, s.inverse, s.end, s.octant));
    }
    slots_open_ = 0;
    for (std::size_t k = 0; k < count; ++k) Advance(open_[k]);
  }

  // Every slot that is under way has come to a cell.
  void MeetCells() {
    ListLeaves();
    for (std::uint32_t kind = 0; kind < kinds; ++kind) {
      if (leaves_[kind].count != 0) MeetLeaves(static_cast<RecordKind>(kind));
    }
    for (std::size_t at = 0; at < lanes_; at += double_lanes) FollowTables(at);
  }

  // Gives each slot a lane, and lists the leaves of their cells by kind.
  HWY_NOINLINE void ListLeaves() {
    for (LeafList& list : leaves_) list.count = 0;
    lanes_ = 0;
    most_leaves_ = 0;
    has_more_bits_ = false;
    const std::size_t count = std::exchange(slots_waiting_, 0);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint8_t slot = waiting_[k];
      const Slot& s = slots_[slot];
      TraversalCounters& counters = (*statistics_)[rays_.queries[s.ray].kind];
      ++counters.cells_visited;
      const Cell& cell = cells_.cells[s.index];
      if (cell.general || cell.extended) {
        LeaveToOthers(slot);
        continue;
      }
      const std::size_t lane = lanes_++;
      slot_[lane] = slot;
      ray_[lane] = static_cast<std::uint8_t>(s.ray);
      t_in_[lane] = s.t_in;
      t_out_[lane] = s.t_out;
      table_[lane] = cell.table;
      if (HWY_UNLIKELY(cell.values == Cell::Values::several)) ListMoreBits(cell, lane);
      counters.primitive_tests += cell.leaf_count;
      most_leaves_ = std::max<std::uint32_t>(most_leaves_, cell.leaf_count);
      for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
        LeafList& list = leaves_[static_cast<std::size_t>(cell.records[i].kind())];
        list.record[list.count] = cells_.records.values(cell.records[i]);
        hwy::Prefetch(list.record[list.count]);
        list.lane[list.count] = static_cast<std::uint8_t>(lane);
        list.place[list.count++] = static_cast<std::uint8_t>(i);
      }
    }
    // Of the last vector's lanes without a ray nothing is asked, but that they hold numbers.
    for (std::size_t lane = lanes_; lane % double_lanes != 0; ++lane) {
      ray_[lane] = ray_[0];
      t_in_[lane] = t_out_[lane] = 0;
      table_[lane] = 0;
    }
    const D d;
    const auto never = hn::Set(d, TableWalk<D>::never);
    for (std::uint32_t i = 0; i < most_leaves_; ++i) {
      for (std::size_t at = 0; at < lanes_; at += double_lanes) {
        hn::Store(never, d, &enter_[i][at]);
        hn::Store(never, d, &leave_[i][at]);
      }
    }
    std::fill_n(unsure_, most_slots, std::uint8_t{0});
  }

  HWY_NOINLINE void ListMoreBits(const Cell& cell, std::size_t lane) {
    if (!has_more_bits_) {
      for (auto& bits : more_bits_) std::fill_n(bits, most_slots, 0);
    }
    has_more_bits_ = true;
    const ValueTable values = cells_.values_of(cell);
    for (std::size_t b = 0; b < std::size(more_bits_); ++b) more_bits_[b][lane] = values.bits[b + 1].word;
  }

  void LeaveToOthers(std::uint8_t slot) {
    found_.Drop(rays_, slots_[slot].ray);
    if (Refill(slot)) Advance(slot);
  }

  HWY_INLINE void MeetLeaves(RecordKind kind) {
    switch (kind) {
      case RecordKind::ball:
        return MeetListed<RecordKind::ball>();
      case RecordKind::aligned_box:
        return MeetListed<RecordKind::aligned_box>();
      case RecordKind::box:
        return MeetListed<RecordKind::box>();
      case RecordKind::upright:
        return MeetListed<RecordKind::upright>();
      case RecordKind::frustum:
        return MeetListed<RecordKind::frustum>();
      case RecordKind::torus:
        return MeetListed<RecordKind::torus>();
      case RecordKind::convex:
      case RecordKind::notch:
      case RecordKind::outline:
      case RecordKind::twisted:
      case RecordKind::revolved:
        return MeetOneByOne(kind);
      case RecordKind::general:
      case RecordKind::instance:
      case RecordKind::mesh:
      case RecordKind::convex_piece:
      case RecordKind::notch_piece:
      case RecordKind::outline_piece:
      case RecordKind::twisted_piece:
      case RecordKind::revolved_piece:
        break;
    }
  }

  // The leaves of one kind, as many at once as a vector has doubles.
  template <RecordKind kind>
  HWY_NOINLINE void MeetListed() {
    const D d;
    const LeafList& list = leaves_[static_cast<std::size_t>(kind)];
    for (std::size_t at = 0; at < list.count; at += double_lanes) {
      const std::size_t here = std::min(double_lanes, list.count - at);
      const double* record[double_lanes];
      std::uint8_t lane[double_lanes], ray[double_lanes];
      for (std::size_t k = 0; k < double_lanes; ++k) {
        const std::size_t from = at + (k < here ? k : 0);
        record[k] = list.record[from];
        lane[k] = list.lane[from];
        ray[k] = ray_[lane[k]];
      }
      const auto t_in = TakeEach(d, [&](std::size_t k) { return t_in_[lane[k]]; });
      const auto t_out = TakeEach(d, [&](std::size_t k) { return t_out_[lane[k]]; });
      const Stretch<D> s = FindStretch(d, rays_.At(d, ray), kind, LaneRecords<D>{record}, cells_.records.least_slope,
                                       cells_.scale.reach, t_in, t_out, hn::FirstN(d, here));
      Keep(d, list, at, here, s);
    }
  }

  HWY_NOINLINE void MeetOneByOne(RecordKind kind) {
    const One one;
    const LeafList& list = leaves_[static_cast<std::size_t>(kind)];
    for (std::size_t at = 0; at < list.count; ++at) {
      const std::size_t lane = list.lane[at];
      const Stretch<One> s =
          FindStretch(one, rays_.At(one, &ray_[lane]), kind, SharedRecord<One>{list.record[at]},
                      cells_.records.least_slope, cells_.scale.reach, t_in_[lane], t_out_[lane], true);
      Keep(one, list, at, 1, s);
    }
  }

  struct LeafList {
    static constexpr std::size_t most = most_slots * Cell::most_tabled;
    std::size_t count = 0;
    const double* record[most];
    std::uint8_t lane[most], place[most];
  };

  // Puts what was found of listed leaves where their rays' lanes are.
  template <class Lanes>
  HWY_INLINE void Keep(Lanes d, const LeafList& list, std::size_t at, std::size_t count, const Stretch<Lanes>& s) {
    HWY_ALIGN double enter[double_lanes];
    HWY_ALIGN double leave[double_lanes];
    const auto never = hn::Set(d, TableWalk<D>::never);
    hn::Store(hn::IfThenElse(s.hit, s.enter, never), d, enter);
    hn::Store(hn::IfThenElse(s.hit, s.leave, never), d, leave);
    std::uint8_t unsure[8] = {};
    hn::StoreMaskBits(d, s.unsure, unsure);
    for (std::size_t k = 0; k < count; ++k) {
      const std::size_t lane = list.lane[at + k], place = list.place[at + k];
      enter_[place][lane] = enter[k];
      leave_[place][lane] = leave[k];
      unsure_[lane] |= static_cast<std::uint8_t>(unsure[0] >> k & 1);
    }
  }

  // What becomes of the rays in a vector of lanes.
  HWY_NOINLINE void FollowTables(std::size_t at) {
    const D d;
    const U u;
    const std::size_t here = std::min(double_lanes, lanes_ - at);
    const auto lanes = hn::FirstN(d, here);
    const auto near = TakeEach(d, [&](std::size_t lane) { return rays_.near[ray_[at + lane]]; });
    const auto start = TakeEach(d, [&](std::size_t lane) { return rays_.start[ray_[at + lane]]; });
    const auto t_in = hn::Load(d, &t_in_[at]), t_out = hn::Load(d, &t_out_[at]);
    TableWalk<D> walk;
    walk.unsure = hn::Lt(near, hn::Zero(d));  // none
    const auto starts = hn::And(lanes, hn::Le(hn::Add(t_in, start), near));
    if (!hn::AllFalse(d, starts)) ClearStarts(at, RayBatch::Bits(starts));
    for (std::uint32_t i = 0; i < most_leaves_; ++i) {
      walk.enter[i] = hn::Load(d, &enter_[i][at]);
      walk.leave[i] = hn::Load(d, &leave_[i][at]);
    }
    const auto together = hn::Mul(near, hn::Set(d, together_to_near_));
    const auto table = hn::Load(u, &table_[at]);
    if (HWY_UNLIKELY(has_more_bits_)) {
      const hn::Vec<U> tables[] = {table, hn::Load(u, &more_bits_[0][at]), hn::Load(u, &more_bits_[1][at])};
      walk.Follow(d, most_leaves_, lanes, tables, t_in, t_out, near, together);
    } else {
      walk.Follow(d, most_leaves_, lanes, table, t_in, t_out, near, together);
    }
    HWY_ALIGN double t[double_lanes];
    HWY_ALIGN std::uint64_t place[double_lanes];
    hn::Store(walk.t, d, t);
    HWY_ALIGN std::uint64_t before[double_lanes];
    HWY_ALIGN std::uint64_t behind[double_lanes];
    hn::Store(walk.place, u, place);
    hn::Store(walk.before, u, before);
    hn::Store(walk.behind, u, behind);
    HWY_ALIGN std::uint64_t coincident[double_lanes];
    hn::Store(walk.coincident, u, coincident);
    const std::uint32_t unsure = RayBatch::Bits(walk.unsure), met = RayBatch::Bits(walk.met),
                        enters = RayBatch::Bits(walk.enters);
    for (std::size_t lane = 0; lane < here; ++lane) {
      const std::uint8_t slot = slot_[at + lane];
      if (((unsure >> lane & 1) | unsure_[at + lane]) != 0) {
        LeaveToOthers(slot);
      } else if ((met >> lane & 1) != 0) {
        const std::size_t i = slots_[slot].ray;
        const std::uint32_t index = slots_[slot].index;
        found_.Keep(rays_, i,
                    {t[lane], index, cells_.cells[index].leaves[static_cast<std::size_t>(place[lane])].get(),
                     before[lane], behind[lane], coincident[lane], (enters >> lane & 1) != 0},
                    any_will_do_);
        if (Refill(slot)) Advance(slot);
      } else {
        Advance(slot);
      }
    }
  }

  // Lanes whose rays start in their cell.
  HWY_NOINLINE void ClearStarts(std::size_t at, std::uint32_t lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
      const std::size_t lane = at + static_cast<std::size_t>(std::countr_zero(lanes));
      const std::size_t i = ray_[lane];
      const Cell& cell = cells_.cells[slots_[slot_[lane]].index];
      for (std::uint32_t place = 0; place < cell.leaf_count; ++place) {
        const bool clear = SingleTracer::ClearStart(rays_.queries[i], cell, place, rays_.near[i], cells_.records,
                                                    enter_[place][lane], leave_[place][lane]);
        unsure_[lane] |= static_cast<std::uint8_t>(clear ? 0 : 1);
      }
    }
  }

  const CellTree& cells_;
  const double together_to_near_;
  RayBatch& rays_;
  BatchFindings& found_;
  std::uint64_t left_ = 0;
  const WaitingVisits* waiting_visits_ = nullptr;
  bool any_will_do_ = false;
  TraversalStatistics* statistics_ = nullptr;

  std::array<Slot, most_slots> slots_{};
  std::array<NodeStack, most_slots> stacks_;
  std::uint8_t open_[most_slots + 1], waiting_[most_slots + 1];  // one more than there are may be written
  std::size_t slots_open_ = 0, slots_waiting_ = 0;

  // Slots that have come to a cell, by lane.
  std::size_t lanes_ = 0;
  std::uint32_t most_leaves_ = 0;
  std::uint8_t slot_[most_slots], ray_[most_slots], unsure_[most_slots];
  HWY_ALIGN std::uint64_t table_[most_slots];
  bool has_more_bits_ = false;
  HWY_ALIGN std::uint64_t more_bits_[ValueTable::bits_per_value - 1][most_slots];
  HWY_ALIGN double t_in_[most_slots];
  HWY_ALIGN double t_out_[most_slots];
  HWY_ALIGN double enter_[Cell::most_tabled][most_slots];
  HWY_ALIGN double leave_[Cell::most_tabled][most_slots];
  std::array<LeafList, kinds> leaves_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
