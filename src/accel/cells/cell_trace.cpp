#include "accel/cells/cell_trace.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <hwy/cache_control.h>

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

void TraceOneByOne(SingleTracer& single, std::span<const RayQuery> queries, std::span<CellAnswer> answers,
                   TraversalStatistics& statistics) {
  for (std::size_t i = 0; i < queries.size(); ++i) {
    TraversalCounters& counters = statistics[queries[i].kind];
    ++counters.rays;
    single.Trace(queries[i], answers[i], counters);
  }
}

// Fewer rays are sooner traced one by one (by trial on the bench).
constexpr std::size_t least_batch = 8;
// Where a block did not pay, those beside it seldom do: so many batches after it are streams at once (by trial on the
// bench).
constexpr std::size_t streams_after_block = 7;

// Asks for what lies further on in memory before it is needed.
HWY_INLINE void Prefetch(std::span<const RayQuery> queries) {
  const auto* first = reinterpret_cast<const char*>(queries.data());
  for (std::size_t byte = 0; byte < queries.size_bytes(); byte += 64) hwy::Prefetch(first + byte);
}

// A function of its own, for what it keeps on the stack would be in the way of single rays.
HWY_NOINLINE void TraceInBatches(const CellTree& cells, double tolerance, SingleTracer& single, std::vector<Run>& runs,
                                 std::span<const RayQuery> queries, std::span<CellAnswer> answers,
                                 TraversalStatistics& statistics) {
  RayBatch rays;
  BatchFindings found;
  BlockTracer block(cells, tolerance, rays, found);
  StreamTracer stream(cells, tolerance, rays, found);
  const BatchAnswers finisher(cells, tolerance / (2 * cells.scale.resolution), rays, found);
  const bool any_will_do = single.wanted() == Wanted::occlusion;
  std::size_t streams_due = 0;
  for (std::size_t begin = 0; begin < queries.size(); begin += RayBatch::most_rays) {
    const std::size_t count = std::min(RayBatch::most_rays, queries.size() - begin);
    rays.Begin(cells, queries.subspan(begin, count));
    for (const RayQuery& query : rays.queries) ++statistics[query.kind].rays;
    const std::size_t next = begin + count;
    Prefetch(queries.subspan(next, std::min(RayBatch::most_rays, queries.size() - next)));
    found.Clear(rays);
    const bool is_block = count >= least_batch && streams_due == 0 && block.Begin();
    const std::uint64_t left = is_block ? block.Trace(any_will_do, statistics[queries[begin].kind]) : rays.in_scene();
    if (is_block && left != 0) {
      streams_due = streams_after_block;
    } else if (streams_due > 0) {
      --streams_due;
    }
    if (left != 0) stream.Trace(left, statistics);
    finisher.Write(answers.subspan(begin, count), single, runs, statistics);
  }
}

void TraceRays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
               std::span<CellAnswer> answers, Wanted wanted, CellScratch& scratch, TraversalStatistics& statistics) {
  scratch.runs.clear();
  SingleTracer single(cells, tree, scratch, wanted);
  if (queries.size() < least_batch) {
    TraceOneByOne(single, queries, answers, statistics);
  } else {
    TraceInBatches(cells, tree.tolerance.distance, single, scratch.runs, queries, answers, statistics);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon::cells {

HWY_EXPORT(TraceRays);

void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                std::span<CellAnswer> answers, Wanted wanted, CellScratch& scratch, TraversalStatistics& statistics) {
  HWY_DYNAMIC_DISPATCH(TraceRays)(cells, tree, queries, answers, wanted, scratch, statistics);
}

}  // namespace tenon::cells
#endif
