#include "accel/cells/cell_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "primitive/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/cells/cell_trace.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/cells/block_tracer-inl.h"
#include "accel/cells/stream_tracer-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

template <class Sink>
HWY_INLINE void TraceOneByOne(SingleTracer& single, std::span<const RayQuery> queries, std::size_t begin,
                              const Sink& sink, TraversalStatistics& statistics) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    TraversalCounters& counters = statistics[queries[i].kind];
    ++counters.rays;
    CellAnswer answer;
    single.Trace(queries[i], answer, counters);
    sink.put(begin + i, answer);
  }
}

// Fewer rays are sooner traced one by one (by trial on the bench).
constexpr std::size_t least_batch = 8;
// Where rays are traced together or one by one, batches after a few that did not go together mostly do not either.
// By trial; it decides nothing but how long they take.
constexpr std::size_t few_apart = 2, batches_left = 14;

void CountRays(const RayBatch& rays, TraversalStatistics& statistics) {
  if (rays.one_kind) {
    statistics[rays.queries[0].kind].rays += rays.count;
  } else {
    for (const RayQuery& query : rays.queries) ++statistics[query.kind].rays;
  }
}

// A function of its own, for what it keeps on the stack would be in the way of single rays.
template <class Sink>
HWY_NOINLINE void TraceInBatches(const CellTree& cells, const CsgTree& tree, SingleTracer& single, CellScratch& scratch,
                                 std::span<const RayQuery> queries, const Sink& sink, TraversalStatistics& statistics) {
  RayBatch rays;
  BatchFindings found;
  StreamTracer stream(cells, rays, found);
  BatchCrossings& crossings = scratch.batch_crossings;
  crossings.begin();
  BlockTracer block(cells, tree, rays, found, crossings, stream);
  const BatchAnswers finisher(cells, rays, found, crossings);
  constexpr bool any_will_do = Sink::wanted == Wanted::occlusion;
  std::size_t apart = 0;  // batches one after another that did not go together
  for (std::size_t begin = 0; begin < queries.size(); begin += rays.count) {
    if (apart >= few_apart) {
      apart = apart + 1 < few_apart + batches_left ? apart + 1 : 0;
      rays.count = std::min(RayBatch::most_rays, queries.size() - begin);
      TraceOneByOne(single, queries.subspan(begin, rays.count), begin, sink, statistics);
      continue;
    }
    rays.Begin(cells, queries.subspan(begin));
    CountRays(rays, statistics);
    found.Clear(rays);
    crossings.clear();
    if (rays.count >= least_batch && block.Begin()) {
      block.Trace(any_will_do, statistics);
      apart = 0;
    } else if (cells.has_few_tables) {
      found.unsure = ~std::uint64_t{0};
      ++apart;
    } else {
      stream.Trace(rays.in_scene(), nullptr, any_will_do, statistics);
    }
    rays.CallLater(RayBatch::most_rays);
    finisher.Write(begin, sink, single, scratch.runs, statistics);
  }
}

template <class Sink>
HWY_INLINE void TraceInto(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                          const Sink& sink, CellScratch& scratch, TraversalStatistics& statistics) {
  scratch.runs.clear();
  SingleTracer single(cells, tree, scratch, Sink::wanted);
  if (queries.size() < least_batch || (cells.has_few_tables && !cells.has_packets)) {
    TraceOneByOne(single, queries, 0, sink, statistics);
  } else {
    TraceInBatches(cells, tree, single, scratch, queries, sink, statistics);
  }
}

void TraceAnswers(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries, const AnswerSink& sink,
                  CellScratch& scratch, TraversalStatistics& statistics) {
  TraceInto(cells, tree, queries, sink, scratch, statistics);
}
void TraceBoundaries(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                     const BoundarySink& sink, CellScratch& scratch, TraversalStatistics& statistics) {
  TraceInto(cells, tree, queries, sink, scratch, statistics);
}
void TraceOcclusion(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                    const OcclusionSink& sink, CellScratch& scratch, TraversalStatistics& statistics) {
  TraceInto(cells, tree, queries, sink, scratch, statistics);
}

bool TraceAll(const CellTree& cells, const CsgTree& tree, const RayQuery& query, TellBoundary tell,
              CellScratch& scratch, TraversalStatistics& statistics) {
  scratch.runs.clear();
  TraversalCounters& counters = statistics[query.kind];
  ++counters.rays;
  return SingleTracer(cells, tree, scratch, Wanted::hit).TraceAll(query, tell, counters);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon::cells {

HWY_EXPORT(TraceAnswers);
HWY_EXPORT(TraceBoundaries);
HWY_EXPORT(TraceOcclusion);
HWY_EXPORT(TraceAll);

void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries, const AnswerSink& sink,
                CellScratch& scratch, TraversalStatistics& statistics) {
  HWY_DYNAMIC_DISPATCH(TraceAnswers)(cells, tree, queries, sink, scratch, statistics);
}
void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries, const BoundarySink& sink,
                CellScratch& scratch, TraversalStatistics& statistics) {
  HWY_DYNAMIC_DISPATCH(TraceBoundaries)(cells, tree, queries, sink, scratch, statistics);
}
void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                const OcclusionSink& sink, CellScratch& scratch, TraversalStatistics& statistics) {
  HWY_DYNAMIC_DISPATCH(TraceOcclusion)(cells, tree, queries, sink, scratch, statistics);
}

bool trace_all(const CellTree& cells, const CsgTree& tree, const RayQuery& query, TellBoundary tell,
               CellScratch& scratch, TraversalStatistics& statistics) {
  return HWY_DYNAMIC_DISPATCH(TraceAll)(cells, tree, query, tell, scratch, statistics);
}

}  // namespace tenon::cells
#endif
