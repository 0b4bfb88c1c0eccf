// How what was found of each ray of a batch becomes an answer. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_BATCH_ANSWERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_BATCH_ANSWERS_INL_H_
#undef TENON_ACCEL_CELLS_BATCH_ANSWERS_INL_H_
#else
#define TENON_ACCEL_CELLS_BATCH_ANSWERS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <limits>

#include "accel/cells/batch_findings-inl.h"
#include "accel/cells/single_tracer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Gives what was found its last bits.
class BatchAnswers {
 public:
  BatchAnswers(const CellTree& tree, const RayBatch& batch, const BatchFindings& findings,
               const BatchCrossings& crossings)
      : cells_(tree),
        together_to_near_(tree.scale.together_to_near()),
        one_medium_(tree.ranks.is_one_medium()),
        rays_(batch),
        found_(findings),
        crossings_(crossings) {}

  /// @param begin  the place of the batch's first ray among those of the sink
  template <class Sink>
  void Write(std::size_t begin, const Sink& sink, SingleTracer& single, std::vector<Run>& runs,
             TraversalStatistics& statistics) const {
    std::uint64_t finished = 0;
    if constexpr (Sink::wanted == Wanted::occlusion) {
      finished = FinishOcclusion(begin, sink);
    } else {
      finished = FinishMisses(begin, sink) | FinishTogether(begin, sink);
      const std::uint64_t groups = found_.Groups(rays_.padded) & ~found_.unsure;
      if (groups != 0) finished |= FinishGroups(groups, runs, begin, sink);
    }
    for (std::uint64_t left = ~finished & AllRays(); left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      CellAnswer answer;
      Answer(i, answer, single, statistics);
      sink.put(begin + i, answer);
    }
  }

 private:
  using D = RayBatch::D;
  static constexpr std::size_t double_lanes = RayBatch::double_lanes;
  static constexpr std::uint32_t all_lanes = (1U << double_lanes) - 1;
  static constexpr std::size_t kinds = static_cast<std::size_t>(ShapeKind::convex) + 1;
  static constexpr double never = std::numeric_limits<double>::infinity();
  // Where fewer share a leaf, or a cell, it is not worth a vector of their own (by trial on the bench).
  static constexpr int least_neighbours = 3;

  std::uint64_t AllRays() const { return ~std::uint64_t{0} >> (RayBatch::most_rays - rays_.count); }

  // Rays that meet nothing, for certain. @return them
  template <class Sink>
  std::uint64_t FinishMisses(std::size_t begin, const Sink& sink) const {
    const std::uint64_t misses = ~found_.Met(rays_.padded) & ~found_.unsure & AllRays();
    for (std::uint64_t left = misses; left != 0; left &= left - 1) {
      sink.put(begin + static_cast<std::size_t>(std::countr_zero(left)), CellAnswer{});
    }
    return misses;
  }

  // Rays of which it is certain whether they meet something before their end. @return them
  template <class Sink>
  std::uint64_t FinishOcclusion(std::size_t begin, const Sink& sink) const {
    const D d;
    std::uint64_t before_end = 0;
    for (std::size_t at = 0; at < rays_.count; at += double_lanes) {
      const auto near = hn::Load(d, rays_.near + at);
      const auto t = hn::Add(hn::Load(d, found_.t + at), hn::Load(d, rays_.start + at));
      const auto certain = hn::Lt(hn::MulAdd(hn::Set(d, 2.0), near, t), hn::Load(d, rays_.end + at));
      before_end |= static_cast<std::uint64_t>(RayBatch::Bits(certain)) << at;
    }
    const std::uint64_t met = found_.Met(rays_.padded);
    const std::uint64_t finished = (before_end | ~met) & ~found_.unsure & AllRays();
    sink.put_known(begin, rays_.count, met);
    return finished;
  }

  // SingleTracer::Finish for rays that do not start on the leaf that they meet: neighbours that meet the same one, and
  // then those that meet leaves of one kind.
  // @return the rays whose answers are complete
  template <class Sink>
  HWY_NOINLINE std::uint64_t FinishTogether(std::size_t begin, const Sink& sink) const {
    std::uint64_t finished = 0;
    std::array<std::uint64_t, kinds> rest{};
    const std::uint64_t simple = Simple();
    CallShapes(simple);
    for (std::size_t at = 0; at < rays_.count; at += double_lanes) {
      std::uint32_t left = static_cast<std::uint32_t>(simple >> at) & all_lanes;
      while (left != 0) {
        const std::size_t first = at + static_cast<std::size_t>(std::countr_zero(left));
        const std::uint32_t same = found_.SameLeaf(at, first) & left;
        left &= ~same;
        const ShapeRef shape = cells_.shapes.of_leaf[found_.leaf(first).get()];
        if (std::popcount(same) < least_neighbours || shape.kind() == ShapeKind::general) {
          if (!has_faces(shape.kind())) rest[static_cast<std::size_t>(shape.kind())] |= std::uint64_t{same} << at;
        } else {
          finished |= FinishNeighbours(at, shape, same, begin, sink);
        }
      }
    }
    for (std::size_t kind = static_cast<std::size_t>(ShapeKind::general) + 1; kind < kinds; ++kind) {
      while (rest[kind] != 0) finished |= FinishSome(static_cast<ShapeKind>(kind), rest[kind], begin, sink);
    }
    return finished;
  }

  // Has the leaves that rays meet come to the cache.
  void CallShapes(std::uint64_t rays) const {
    const auto call_each = [&](const auto& call) {
      for (std::uint64_t left = rays; left != 0; left &= left - 1) {
        call(cells_.shapes.of_leaf[found_.leaf(static_cast<std::size_t>(std::countr_zero(left))).get()]);
      }
    };
    call_each([](const ShapeRef& shape) { hwy::Prefetch(&shape); });
    call_each([&](const ShapeRef& shape) { cells_.shapes.prefetch(shape); });
  }

  // Rays that meet one face, and do not start on that leaf.
  std::uint64_t Simple() const {
    std::uint64_t simple = found_.Met(rays_.padded) & ~found_.unsure & ~found_.Groups(rays_.padded) & AllRays();
    if (!rays_.has_from) return simple;
    for (std::uint64_t left = simple; left != 0; left &= left - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      if (start_face(rays_.queries[i], found_.leaf(i)) >= 0) simple &= ~(std::uint64_t{1} << i);
    }
    return simple;
  }

  // SingleTracer::FinishGroup for neighbours that meet the same cell, and do not start there.
  template <class Sink>
  HWY_NOINLINE std::uint64_t FinishGroups(std::uint64_t groups, std::vector<Run>& runs, std::size_t begin,
                                          const Sink& sink) const {
    std::uint64_t finished = 0;
    for (std::size_t at = 0; at < rays_.count; at += double_lanes) {
      std::uint32_t left = static_cast<std::uint32_t>(groups >> at) & all_lanes;
      while (left != 0) {
        const std::size_t first = at + static_cast<std::size_t>(std::countr_zero(left));
        const std::uint32_t same = found_.SameCell(at, first) & left;
        left &= ~same;
        if (std::popcount(same) < least_neighbours) continue;
        finished |= FinishGroup(at, cells_.cells[found_.cell(first)], same, runs, begin, sink);
      }
    }
    return finished;
  }

  // Ends of a cell's leaves with their last bits, by place; those alone that coincide with others.
  struct ExactEnds {
    HWY_ALIGN double t[Cell::most_tabled][double_lanes];
    HWY_ALIGN double face[Cell::most_tabled][double_lanes];
  };

  template <class Sink>
  std::uint64_t FinishGroup(std::size_t at, const Cell& cell, std::uint32_t lanes, std::vector<Run>& runs,
                            std::size_t begin, const Sink& sink) const {
    ExactEnds ends;
    std::uint64_t done = 0;
    for (lanes = FindEnds(at, cell, lanes, ends); lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      CellAnswer answer;
      if (!TellEnds(at, lane, cell, ends, Sink::wanted == Wanted::hit, runs, answer)) continue;
      sink.put(begin + at + lane, answer);
      done |= std::uint64_t{1} << (at + lane);
    }
    return done;
  }

  // @return the lanes whose ends are all certain
  std::uint32_t FindEnds(std::size_t at, const Cell& cell, std::uint32_t lanes, ExactEnds& found) const {
    const D d;
    const RayLanes<D> rays = Rays([&](const double* values) { return hn::Load(d, values + at); });
    const auto length = hn::Load(d, rays_.length + at), near = hn::Load(d, rays_.near + at);
    const auto about = hn::Add(hn::Load(d, found_.t + at), hn::Load(d, rays_.start + at));
    for (std::uint32_t place = 0; place < cell.leaf_count; ++place) {
      const auto enters = found_.EnteringAmong(at, place), ends = hn::Or(enters, found_.LeavingAmong(at, place));
      if ((RayBatch::Bits(ends) & lanes) == 0) continue;
      const ShapeRef shape = cells_.shapes.of_leaf[cell.leaves[place].get()];
      if (shape.kind() == ShapeKind::general || shape.kind() == ShapeKind::torus) return 0;
      const auto take = [&]<class Shape>(const HugePageVector<Shape>& list) {
        return SharedShape<D, Shape>(list[shape.index()]);
      };
      const CrossingLanes<D> end =
          FindCrossing(d, rays, cells_.shapes, shape.kind(), take, -1, cells_.scale.reach, length, enters, about);
      const auto sure = hn::AndNot(end.unsure, hn::Le(hn::Abs(hn::Sub(end.t, about)), near));
      lanes &= ~RayBatch::Bits(hn::AndNot(sure, ends));
      hn::Store(end.t, d, found.t[place]);
      hn::Store(end.face, d, found.face[place]);
    }
    return lanes;
  }

  // What the ray in a lane meets. @return false where that is not certain, or it starts there
  bool TellEnds(std::size_t at, std::size_t lane, const Cell& cell, const ExactEnds& found, bool wants_faces,
                std::vector<Run>& runs, CellAnswer& answer) const {
    const std::size_t i = at + lane;
    const RayQuery& query = rays_.queries[i];
    const auto leaves = std::span(cell.leaves).first(cell.leaf_count);
    if (std::ranges::any_of(leaves, [&](LeafId leaf) { return start_face(query, leaf) >= 0; })) return false;
    const CoincidentEnds ends = found_.coincident(i);
    CrossingGroup group;
    for (std::uint32_t left = ends.entered() | ends.left(); left != 0; left &= left - 1) {
      const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
      group.add({found.t[place][lane], place, (ends.entered() >> place & 1) != 0});
    }
    const auto face_at = [&](std::uint32_t place, bool) {
      return LeafFace{cell.leaves[place], static_cast<std::uint32_t>(found.face[place][lane])};
    };
    const GroupLimits limits{0.5 * rays_.near[i], together_to_near_ * rays_.near[i], wants_faces};
    if (!TellFoundGroup(cells_, cell, group, ends.after(), face_at, limits, runs, answer)) return false;
    answer.kind = answer.t < query.t_max ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    answer.cell = found_.cell(i);
    return true;
  }

  template <class Sink>
  std::uint64_t FinishNeighbours(std::size_t at, ShapeRef shape, std::uint32_t lanes, std::size_t begin,
                                 const Sink& sink) const {
    const D d;
    std::array<std::uint8_t, double_lanes> places;
    for (std::size_t lane = 0; lane < double_lanes; ++lane) places[lane] = static_cast<std::uint8_t>(at + lane);
    const auto take = [&](const double* values) { return hn::Load(d, values + at); };
    const auto take_shape = [&]<class Shape>(const HugePageVector<Shape>& list) {
      return SharedShape<D, Shape>(list[shape.index()]);
    };
    return Complete(shape.kind(), take, take_shape, places, found_.Entering(at), lanes, begin, sink);
  }

  // @param left  rays that meet leaves of the kind; those that are dealt with are taken out
  template <class Sink>
  std::uint64_t FinishSome(ShapeKind kind, std::uint64_t& left, std::size_t begin, const Sink& sink) const {
    const D d;
    std::array<std::uint8_t, double_lanes> places;
    std::uint32_t lanes = 0;
    std::size_t i = 0;
    for (std::size_t lane = 0; lane < double_lanes; ++lane) {
      // Lanes without a ray repeat the last one.
      if (left != 0) {
        i = static_cast<std::size_t>(std::countr_zero(left));
        left &= left - 1;
        lanes |= 1U << lane;
      }
      places[lane] = static_cast<std::uint8_t>(i);
    }
    const auto take = [&](const double* values) {
      return TakeEach(d, [&](std::size_t lane) { return values[places[lane]]; });
    };
    const auto take_shapes = [&]<class Shape>(const HugePageVector<Shape>& list) {
      LaneShapes<D, Shape> shapes;
      for (std::size_t lane = 0; lane < double_lanes; ++lane) {
        shapes.Put(lane, list[cells_.shapes.of_leaf[found_.leaf(places[lane]).get()].index()]);
      }
      return shapes;
    };
    std::uint8_t entering[8] = {};
    for (std::size_t lane = 0; lane < double_lanes; ++lane) {
      entering[0] |= static_cast<std::uint8_t>(static_cast<int>(found_.enters(places[lane])) << lane);
    }
    return Complete(kind, take, take_shapes, places, hn::LoadMaskBits(d, entering), lanes, begin, sink);
  }

  template <class Take>
  HWY_INLINE RayLanes<D> Rays(const Take& take) const {
    const D d;
    RayLanes<D> ray;
    ray.origin = {take(rays_.query_origin[0]), take(rays_.query_origin[1]), take(rays_.query_origin[2])};
    ray.direction = {take(rays_.direction[0]), take(rays_.direction[1]), take(rays_.direction[2])};
    ray.square = Dot(ray.direction, ray.direction);
    ray.inverse = hn::Div(hn::Set(d, 1.0), ray.square);
    ray.resolution = hn::Mul(hn::Set(d, 0.5), take(rays_.near));
    return ray;
  }

  // The answers of rays at some places that meet leaves of one kind, where the crossing of spans() is certain.
  // @param take, take_shapes  called with a list of numbers, or of shapes: those of the places
  // @param enters             the places whose rays enter their leaf
  // @param lanes              the places that matter
  template <class Take, class TakeShapes, class Sink>
  HWY_INLINE std::uint64_t Complete(ShapeKind kind, const Take& take, const TakeShapes& take_shapes,
                                    const std::array<std::uint8_t, double_lanes>& places, hn::Mask<D> enters,
                                    std::uint32_t lanes, std::size_t begin, const Sink& sink) const {
    const D d;
    const auto about = hn::Add(take(found_.t), take(rays_.start));
    CrossingLanes<D> end;
    if (kind == ShapeKind::torus) {
      end = TorusCrossing(d, Rays(take), take_shapes(cells_.shapes.tori), about, enters);
    } else {
      end = FindCrossing(d, Rays(take), cells_.shapes, kind, take_shapes, -1, cells_.scale.reach, take(rays_.length),
                         enters, about);
    }
    const auto sure = hn::AndNot(end.unsure, hn::Le(hn::Abs(hn::Sub(end.t, about)), take(rays_.near)));
    const auto in_time = hn::Lt(end.t, take(rays_.end));
    HWY_ALIGN double t[double_lanes];
    HWY_ALIGN double face[double_lanes];
    hn::Store(hn::IfThenElse(in_time, end.t, hn::Set(d, never)), d, t);
    hn::Store(end.face, d, face);
    std::uint64_t done = 0;
    for (lanes &= RayBatch::Bits(sure); lanes != 0; lanes &= lanes - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(lanes));
      const std::size_t i = places[lane];
      Put(i, t[lane], static_cast<std::uint32_t>(face[lane]), begin, sink);
      done |= std::uint64_t{1} << i;
    }
    return done;
  }

  // @param t  of the boundary; infinite where that lies behind the ray's end
  template <class Sink>
  HWY_INLINE void Put(std::size_t i, double t, std::uint32_t face, std::size_t begin, const Sink& sink) const {
    if constexpr (Sink::wanted == Wanted::boundary) {
      if (HWY_LIKELY(one_medium_)) {
        return sink.put_known(begin + i, t, {found_.leaf(i), face}, t < never && found_.behind(i) != 0);
      }
    }
    CellAnswer answer;
    answer.t = t;
    answer.kind = t < never ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    answer.cell = found_.cell(i);
    answer.surface = {found_.leaf(i), face};
    answer.leaf_entering = found_.enters(i);
    found_.TakeValues(i, answer);
    sink.put(begin + i, answer);
  }

  void Answer(std::size_t i, CellAnswer& answer, SingleTracer& single, TraversalStatistics& statistics) const {
    const RayQuery& query = rays_.queries[i];
    if ((found_.unsure >> i & 1) != 0) return single.TraceOfBatch(query, i, answer, statistics[query.kind]);
    answer.cell = found_.cell(i);
    answer.t = found_.t[i] + rays_.start[i];
    if (found_.coincident(i).word != 0) return single.FinishGroup(query, answer);
    answer.surface = {found_.leaf(i), 0};
    answer.leaf_entering = found_.enters(i);
    found_.TakeValues(i, answer);
    if (TakeKnown(i, answer)) return;
    single.BeginKnown(query);
    single.Finish(answer);
  }

  // Gives a boundary its last bits, where the rays of the batch were asked for them together. @return whether they were
  bool TakeKnown(std::size_t i, CellAnswer& answer) const {
    const double near = rays_.near[i];
    const NextCrossing* const next = crossings_.behind(answer.surface.leaf, i, answer.t - 2 * near);
    if (next == nullptr || next->kind == NextCrossing::Kind::nothing) return false;
    const Crossing& crossing = next->crossing;
    if (!(std::fabs(crossing.t - answer.t) <= near) || crossing.entering != answer.leaf_entering) return false;
    answer.t = crossing.t;
    answer.surface.face = crossing.face;
    answer.kind = crossing.t < rays_.queries[i].t_max ? CellAnswer::Kind::boundary : CellAnswer::Kind::nothing;
    return true;
  }

  const CellTree& cells_;
  const double together_to_near_;
  const bool one_medium_;
  const RayBatch& rays_;
  const BatchFindings& found_;
  const BatchCrossings& crossings_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
