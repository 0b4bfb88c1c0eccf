// Many rays that go much the same way, through the cells together. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_
#undef TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_
#else
#define TENON_ACCEL_CELLS_BLOCK_TRACER_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>

#include "accel/cells/stream_tracer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Follows up to 64 rays into one octant. Nodes are opened for all of them at once, by intervals that hold their
/// origins and directions (Wald et al. 2007, "Ray tracing deformable scenes using dynamic bounding volume hierarchies":
/// frustum culling by interval arithmetic); what is left are the cells that some of them may meet.
class BlockTracer {
 public:
  /// @param streams  of the same batch
  BlockTracer(const CellTree& cells, const CsgTree& tree, RayBatch& rays, BatchFindings& found,
              BatchCrossings& crossings, StreamTracer& streams)
      : cells_(cells),
        tree_(tree),
        together_to_near_(cells.scale.together_to_near()),
        rays_(rays),
        found_(found),
        crossings_(crossings),
        streams_(streams) {}

  /// Whether the rays make a block: they are of one kind and go into one octant, and nowhere near along its planes, and
  /// not far apart.
  bool Begin() {
    if (rays_.unsound != 0 || !rays_.one_kind) return false;
    const D d;
    const auto zero = hn::Zero(d);
    const std::uint32_t octant = rays_.octant(0);
    const double unit = 2 * cells_.scale.resolution;  // RayBatch::near is this over the length of the direction
    for (std::size_t a = 0; a < 3; ++a) {
      backward_[a] = octant >> a & 1;
      auto least = hn::Set(d, 2 * unit), greatest = hn::Set(d, -2 * unit);
      auto one_side = hn::Eq(zero, zero);
      for (std::size_t i = 0; i < rays_.padded; i += double_lanes) {
        const auto v = hn::Load(d, &rays_.direction[a][i]);
        // A direction of zero has no side of its own.
        one_side = hn::And(one_side, backward_[a] != 0 ? hn::Lt(v, zero) : hn::Gt(v, zero));
        const auto share = hn::Mul(v, hn::Load(d, &rays_.near[i]));
        least = hn::Min(least, share);
        greatest = hn::Max(greatest, share);
      }
      if (!hn::AllTrue(d, one_side)) return false;
      const double spread = hn::GetLane(hn::MaxOfLanes(d, greatest)) - hn::GetLane(hn::MinOfLanes(d, least));
      if (spread > widest_spread * unit) return false;
    }
    FindIntervals();
    return true;
  }

  /// Traces them.
  /// @param any_will_do  whether any boundary ends a ray
  void Trace(bool any_will_do, TraversalStatistics& statistics) {
    any_will_do_ = any_will_do;
    statistics_ = &statistics;
    Walk();
    TraversalCounters& counters = statistics[rays_.queries[0].kind];
    counters.cells_visited += visited_;
    counters.primitive_tests += tests_;
  }

 private:
  using D = RayBatch::D;
  using U = hn::RebindToUnsigned<D>;
  using F = RayBatch::F;
  using HalfF = RayBatch::HalfF;
  static constexpr std::size_t double_lanes = RayBatch::double_lanes, float_lanes = RayBatch::float_lanes;

  // Rays further apart than this share few cells: the spread of a component of their directions, at length 1. Set by
  // trial on the bench; it decides who traces a ray, never what comes of it.
  static constexpr double widest_spread = 0.25;

  // Rays that do not meet the scene have no part in them.
  void FindIntervals() {
    const F f;
    const auto infinity = hn::Set(f, std::numeric_limits<float>::infinity()), zero = hn::Zero(f);
    for (std::size_t a = 0; a < 3; ++a) {
      auto low_origin = infinity, low_inverse = infinity;
      auto high_origin = hn::Neg(infinity), high_inverse = hn::Neg(infinity);
      for (std::size_t i = 0; i < rays_.padded; i += float_lanes) {
        const auto meets = hn::Ge(hn::Load(f, &rays_.box_end[i]), zero);
        const auto origin = hn::Load(f, &rays_.box_origin[a][i]), inverse = hn::Load(f, &rays_.box_inverse[a][i]);
        low_origin = hn::Min(low_origin, hn::IfThenElse(meets, origin, infinity));
        low_inverse = hn::Min(low_inverse, hn::IfThenElse(meets, inverse, infinity));
        high_origin = hn::Max(high_origin, hn::IfThenElse(meets, origin, hn::Neg(infinity)));
        high_inverse = hn::Max(high_inverse, hn::IfThenElse(meets, inverse, hn::Neg(infinity)));
      }
      low_origin_[a] = hn::GetLane(hn::MinOfLanes(f, low_origin));
      low_inverse_[a] = hn::GetLane(hn::MinOfLanes(f, low_inverse));
      high_origin_[a] = hn::GetLane(hn::MaxOfLanes(f, high_origin));
      high_inverse_[a] = hn::GetLane(hn::MaxOfLanes(f, high_inverse));
    }
  }

  struct Entry {
    std::uint32_t child;
    float key;
    std::array<float, 6> box;  // ends nearest to the start by axis, then those furthest
  };

  // Pushes the children that some ray may meet, the nearest last.
  HWY_INLINE void Open(const WideNode& node, Entry*& top) {
    const hn::CappedTag<float, node_width> wide;
    HWY_ALIGN float t_in[node_width];
    std::uint32_t met = 0;
    for (std::size_t lane = 0; lane < node_width; lane += hn::Lanes(wide)) {
      auto near = hn::Zero(wide), far = hn::Set(wide, longest_);
      for (std::size_t a = 0; a < 3; ++a) {
        const bool backward = backward_[a] != 0;
        const auto first = static_cast<std::size_t>(backward_[a]);
        const auto low = hn::Set(wide, low_inverse_[a]), high = hn::Set(wide, high_inverse_[a]);
        // The least product is that with the origin nearest behind the plane, and the greatest the other way round.
        const auto in = hn::Sub(hn::Load(wide, node.ends[a][first].data() + lane),
                                hn::Set(wide, backward ? low_origin_[a] : high_origin_[a]));
        const auto out = hn::Sub(hn::Load(wide, node.ends[a][1 - first].data() + lane),
                                 hn::Set(wide, backward ? high_origin_[a] : low_origin_[a]));
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
      cells_.prefetch(node.children[lane]);
      Entry entry;
      entry.child = node.children[lane].bits;
      entry.key = t_in[lane];
      for (std::size_t a = 0; a < 3; ++a) {
        const auto side = static_cast<std::size_t>(backward_[a]);
        entry.box[a] = node.ends[a][side][lane];
        entry.box[3 + a] = node.ends[a][1 - side][lane];
      }
      Entry* place = top++;
      for (; place != first && place[-1].key < entry.key; --place) *place = place[-1];
      *place = entry;
    }
  }

  // A step of the block costs about what it costs to bring so many rays one cell further one by one. Rays whose ways
  // lie apart share few cells, while the block opens all that lie between them: then each node and cell is left to
  // streams that few of the rays go through, as soon as they are many enough together. Blocks beside such a one seldom
  // hold together longer. All these numbers are set by trial on the bench; they decide who traces a ray, never what
  // comes of it.
  static constexpr std::uint64_t least_rays_a_step = 2;
  static constexpr std::uint64_t steps_of_grace = 48;
  static constexpr std::size_t blocks_apart = 15;
  static constexpr int least_together = 24;
  static constexpr std::size_t least_waiting = 48;
  // Rays of the next batch that are asked for at each step.
  static constexpr std::size_t called_a_step = 8;

  void Walk() {
    visited_ = tests_ = 0;
    ShortenBlock();
    if (longest_ < 0) return;
    bool apart = apart_due_ > 0;
    if (apart) --apart_due_;
    waiting_.Clear();
    Entry* const stack = stack_.data();
    Entry* top = stack;
    Open(cells_.nodes.front(), top);
    std::uint64_t steps = 0;
    while (top != stack) {
      rays_.CallLater(called_a_step);
      const Entry entry = *--top;
      // Every ray has its boundary by then.
      if (entry.key > longest_) continue;
      if (!apart && ++steps > steps_of_grace && visited_ < least_rays_a_step * (steps - steps_of_grace)) {
        apart = true;
        apart_due_ = blocks_apart;
      }
      const ChildRef child{entry.child};
      if (!apart && !child.is_cell()) {
        Open(cells_.nodes[child.index()], top);
        continue;
      }
      const std::uint64_t rays = FindWays(entry);
      if (rays == 0) continue;
      if (apart && std::popcount(rays) < least_together) {
        LeaveToStreams(child, rays);
        if (waiting_.total() >= least_waiting || !waiting_.has_room()) TraceStreams();
      } else if (!child.is_cell()) {
        Open(cells_.nodes[child.index()], top);
      } else if (MeetCell(child.index(), rays)) {
        ShortenBlock();
      }
    }
    if (waiting_.total() != 0) TraceStreams();
  }

  void LeaveToStreams(ChildRef child, std::uint64_t rays) {
    for (; rays != 0; rays &= rays - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(rays));
      waiting_.Add(i, {child, t_in_[i], t_out_[i]});
    }
  }

  HWY_NOINLINE void TraceStreams() {
    streams_.Trace(waiting_.rays(), &waiting_, any_will_do_, *statistics_);
    waiting_.Clear();
    ShortenBlock();
  }

  void ShortenBlock() {
    const F f;
    auto longest = hn::Load(f, rays_.box_end);
    for (std::size_t i = float_lanes; i < rays_.padded; i += float_lanes)
      longest = hn::Max(longest, hn::Load(f, rays_.box_end + i));
    longest_ = hn::GetLane(hn::MaxOfLanes(f, longest));
  }

  // Where each ray is in a box. @return the rays that meet it
  std::uint64_t FindWays(const Entry& entry) {
    const F f;
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < rays_.padded; i += float_lanes) {
      auto near = hn::Zero(f), far = hn::Load(f, rays_.box_end + i);
      for (std::size_t a = 0; a < 3; ++a) {
        const auto shift = hn::Load(f, &rays_.box_shift[a][i]), inverse = hn::Load(f, &rays_.box_inverse[a][i]);
        near = hn::Max(near, hn::MulSub(hn::Set(f, entry.box[a]), inverse, shift));
        far = hn::Min(far, hn::MulSub(hn::Set(f, entry.box[3 + a]), inverse, shift));
      }
      hn::Store(near, f, t_in_ + i);
      hn::Store(far, f, t_out_ + i);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(f, hn::Le(near, far), bits);
      rays |= static_cast<std::uint64_t>(bits[0] | bits[1] << 8) << i;
    }
    return rays;
  }

  // @return whether some ray became shorter
  bool MeetCell(std::uint32_t index, std::uint64_t rays) {
    const D d;
    const HalfF half;
    bool shorter = false;
    for (std::size_t i = 0; i < rays_.padded; i += double_lanes) {
      if ((rays >> i & ((1U << double_lanes) - 1)) == 0) continue;
      const auto in = hn::PromoteTo(d, hn::Load(half, t_in_ + i)), out = hn::PromoteTo(d, hn::Load(half, t_out_ + i));
      const auto lanes = hn::Le(in, out);
      visited_ += hn::CountTrue(d, lanes);
      shorter |= Meet(index, i, lanes, in, out);
    }
    return shorter;
  }

  // Has rays traced no further. @return true, for they became shorter
  bool Drop(std::size_t at, std::uint32_t lanes) {
    for (; lanes != 0; lanes &= lanes - 1) found_.Drop(rays_, at + static_cast<std::size_t>(std::countr_zero(lanes)));
    return true;
  }

  // SingleTracer::MeetOtherwise for lanes at `at`. What a leaf is crossed by that tells its crossings one after another
  // is found for all rays of the block.
  HWY_NOINLINE bool MeetOtherwise(std::uint32_t index, std::size_t at, std::uint32_t lanes) {
    const Cell& cell = cells_.cells[index];
    if (!is_of_meshes(cell)) return Drop(at, lanes);
    const bool is_alone = cell.leaf_count == 1;
    for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
      if (cell.records[i].kind() != RecordKind::mesh) continue;
      // Where a ray is within one leaf while it comes to another, that behind the first tells.
      tests_ +=
          static_cast<std::uint64_t>(crossings_.find(tree_, cell.leaves[i], rays_.queries, rays_.packet(), !is_alone));
    }
    if (!is_alone) return Drop(at, lanes);
    bool shorter = false;
    for (; lanes != 0; lanes &= lanes - 1) {
      shorter |= MeetAlone(index, at + static_cast<std::size_t>(std::countr_zero(lanes)));
    }
    return shorter;
  }

  // SingleTracer::MeetAlone for a ray. @return whether it became shorter
  bool MeetAlone(std::uint32_t index, std::size_t i) {
    const Cell& cell = cells_.cells[index];
    const LeafId leaf = cell.leaves[0];
    const double start = rays_.start[i];
    // At least from where the batch's crossings are known.
    const double from = std::max(t_in_[i] + start, 0.0);
    const NextCrossing* const next = crossings_.behind(leaf, i, from);
    if (next == nullptr) {
      found_.Drop(rays_, i);
      return true;
    }
    const Crossing& crossing = next->crossing;
    if (next->kind == NextCrossing::Kind::nothing || crossing.t > t_out_[i] + start) return false;
    const std::uint64_t outside = cell.table & 1, inside = cell.table >> 1 & 1;
    const bool enters = crossing.entering;
    found_.Keep(
        rays_, i,
        {crossing.t - start, index, leaf.get(), enters ? outside : inside, enters ? inside : outside, 0, enters},
        any_will_do_);
    return true;
  }

  // SingleTracer::Meet for the lanes at `at`; what it has to ask for is left to it.
  bool Meet(std::uint32_t index, std::size_t at, hn::Mask<D> lanes, hn::Vec<D> t_in, hn::Vec<D> t_out) {
    const Cell& cell = cells_.cells[index];
    if (cell.general || cell.extended) return MeetOtherwise(index, at, RayBatch::Bits(lanes));
    const D d;
    const U u;
    const SceneRays<D> ray = rays_.At(at);
    const auto never = hn::Set(d, TableWalk<D>::never);
    const std::uint32_t count = cell.leaf_count;
    tests_ += count * hn::CountTrue(d, lanes);
    const auto starts = hn::And(lanes, hn::Le(hn::Add(t_in, hn::Load(d, &rays_.start[at])), ray.near));
    const bool any_starts = !hn::AllFalse(d, starts);
    TableWalk<D> walk;
    walk.unsure = hn::Lt(ray.near, hn::Zero(d));  // none
    for (std::uint32_t i = 0; i < count; ++i) {
      const Stretch<D> s = FindStretch(d, ray, cells_.records, cell.records[i], cells_.scale.reach, t_in, t_out, lanes);
      walk.enter[i] = hn::IfThenElse(s.hit, s.enter, never);
      walk.leave[i] = hn::IfThenElse(s.hit, s.leave, never);
      walk.unsure = hn::Or(walk.unsure, s.unsure);
      if (HWY_UNLIKELY(any_starts)) {
        walk.unsure = hn::Or(walk.unsure, DoubtStarts(cell, i, at, starts, ray.near, walk.enter[i], walk.leave[i]));
      }
    }
    const auto together = hn::Mul(ray.near, hn::Set(d, together_to_near_));
    const auto table = hn::Set(u, cell.table);
    if (HWY_LIKELY(cell.values != Cell::Values::several)) {
      walk.Follow(d, count, lanes, table, t_in, t_out, ray.near, together);
    } else {
      const ValueTable values = cells_.values_of(cell);
      const hn::Vec<U> tables[] = {table, hn::Set(u, values.bits[1].word), hn::Set(u, values.bits[2].word)};
      walk.Follow(d, count, lanes, tables, t_in, t_out, ray.near, together);
    }
    bool shorter = false;
    if (HWY_UNLIKELY(!hn::AllFalse(d, walk.unsure))) shorter = Drop(at, RayBatch::Bits(walk.unsure));
    if (hn::AllFalse(d, walk.met)) return shorter;
    auto leaf = hn::Set(u, cell.leaves[0].get());
    for (std::uint32_t i = 1; i < count; ++i) {
      leaf = hn::IfThenElse(hn::Eq(walk.place, hn::Set(u, i)), hn::Set(u, cell.leaves[i].get()), leaf);
    }
    const BatchFindings::Boundaries boundaries{walk.t,      hn::Set(u, index), leaf,       walk.before,
                                               walk.behind, walk.coincident,   walk.enters};
    return found_.Keep(rays_, at, walk.met, boundaries, any_will_do_) || shorter;
  }

  // SingleTracer::ClearStart for the lanes of `starts`.
  // @return those in which something other than the faces that a ray starts on may lie at its start
  HWY_INLINE hn::Mask<D> DoubtStarts(const Cell& cell, std::uint32_t place, std::size_t at, hn::Mask<D> starts,
                                     hn::Vec<D> near, hn::Vec<D>& enter, hn::Vec<D>& leave) {
    const D d;
    const auto zero = hn::Zero(d);
    const auto enters_here = hn::Le(hn::Abs(enter), near), leaves_here = hn::Le(hn::Abs(leave), near);
    if (!rays_.has_from) return hn::And(starts, hn::Or(enters_here, leaves_here));
    const auto leaf = hn::Set(d, static_cast<double>(cell.leaves[place].get()));
    auto is_from = hn::Lt(near, zero);  // none
    for (std::size_t k = 0; k < rays_.start_leaves; ++k) {
      is_from = hn::Or(is_from, hn::Eq(hn::Load(d, &rays_.start_leaf[k][at]), leaf));
    }
    is_from = hn::And(is_from, starts);
    enter = hn::IfThenElse(hn::And(is_from, enters_here), zero, enter);
    leave = hn::IfThenElse(hn::And(is_from, leaves_here), zero, leave);
    // Where the ray starts on a face of the leaf one end lies there; else none.
    const auto one = hn::Xor(enters_here, leaves_here), any = hn::Or(enters_here, leaves_here);
    auto doubt = hn::And(starts, hn::Or(hn::AndNot(one, is_from), hn::AndNot(is_from, any)));
    const RecordRef record = cell.records[place];
    if (!LeafRecords::may_doubt_starts(record.kind())) return doubt;
    HWY_ALIGN double doubts[double_lanes] = {};
    for (std::uint32_t bits = RayBatch::Bits(is_from); bits != 0; bits &= bits - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(bits));
      const RayQuery& query = rays_.queries[at + lane];
      const int on_face = start_face(query, cell.leaves[place]);
      if (!cells_.records.start_is_certain(record, on_face, query.ray.direction)) doubts[lane] = 1;
    }
    return hn::Or(doubt, hn::Gt(hn::Load(d, doubts), zero));
  }

  const CellTree& cells_;
  const CsgTree& tree_;
  const double together_to_near_;
  RayBatch& rays_;
  BatchFindings& found_;
  BatchCrossings& crossings_;
  StreamTracer& streams_;
  TraversalStatistics* statistics_ = nullptr;
  bool any_will_do_ = false;
  std::size_t apart_due_ = 0;  // blocks that are taken for apart from the start
  float longest_ = -1;         // of what is left of the rays
  /// What holds those of all rays that are not done at the beginning.
  float low_origin_[3] = {}, high_origin_[3] = {}, low_inverse_[3] = {}, high_inverse_[3] = {};
  std::array<std::size_t, 3> backward_{};  // by axis: 1 where all directions are negative
  std::uint64_t visited_ = 0, tests_ = 0;
  std::array<Entry, most_pending> stack_;
  WaitingVisits waiting_;
  HWY_ALIGN float t_in_[RayBatch::most_rays];  // what FindWays() found
  HWY_ALIGN float t_out_[RayBatch::most_rays];
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
