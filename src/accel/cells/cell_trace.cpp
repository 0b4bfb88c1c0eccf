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
HWY_INLINE void TraceOneByOne(SingleTracer& single, std::span<const RayQuery> queries, const Sink& sink,
                              TraversalStatistics& statistics) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    TraversalCounters& counters = statistics[queries[i].kind];
    ++counters.rays;
    CellAnswer answer;
    single.Trace(queries[i], answer, counters);
    sink.put(i, answer);
  }
}

// Fewer rays are sooner traced one by one (by trial on the bench).
constexpr std::size_t least_batch = 8;
void CountRays(const RayBatch& rays, TraversalStatistics& statistics) {
  if (rays.one_kind) {
    statistics[rays.queries[0].kind].rays += rays.count;
  } else {
    for (const RayQuery& query : rays.queries) ++statistics[query.kind].rays;
  }
}

// A function of its own, for what it keeps on the stack would be in the way of single rays.
template <class Sink>
HWY_NOINLINE void TraceInBatches(const CellTree& cells, SingleTracer& single, std::vector<Run>& runs,
                                 std::span<const RayQuery> queries, const Sink& sink, TraversalStatistics& statistics) {
  RayBatch rays;
  BatchFindings found;
  StreamTracer stream(cells, rays, found);
  BlockTracer block(cells, rays, found, stream);
  const BatchAnswers finisher(cells, rays, found);
  constexpr bool any_will_do = Sink::wanted == Wanted::occlusion;
  for (std::size_t begin = 0; begin < queries.size(); begin += rays.count) {
    rays.Begin(cells, queries.subspan(begin));
    CountRays(rays, statistics);
    found.Clear(rays);
    if (rays.count >= least_batch && block.Begin()) {
      block.Trace(any_will_do, statistics);
    } else {
      stream.Trace(rays.in_scene(), nullptr, any_will_do, statistics);
    }
    rays.CallLater(RayBatch::most_rays);
    finisher.Write(begin, sink, single, runs, statistics);
  }
}

template <class Sink>
HWY_INLINE void TraceInto(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                          const Sink& sink, CellScratch& scratch, TraversalStatistics& statistics) {
  scratch.runs.clear();
  SingleTracer single(cells, tree, scratch, Sink::wanted);
  if (queries.size() < least_batch || cells.has_few_tables) {
    TraceOneByOne(single, queries, sink, statistics);
  } else {
    TraceInBatches(cells, single, scratch.runs, queries, sink, statistics);
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
