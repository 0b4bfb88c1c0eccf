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

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

void TraceRays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
               std::span<CellAnswer> answers, Wanted wanted, CellScratch& scratch, TraversalStatistics& statistics) {
  scratch.runs.clear();
  SingleTracer single(cells, tree, scratch, wanted);
  const auto trace_singly = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) answers[i] = single.Trace(queries[i], statistics[queries[i].kind]);
  };
  // Fewer rays are sooner traced one by one.
  constexpr std::size_t least = 8;
  if (queries.size() < least) return trace_singly(0, queries.size());
  BlockTracer block(cells, tree.tolerance.distance);
  for (std::size_t begin = 0; begin < queries.size();) {
    // Where many do not make a block, some of them may.
    std::size_t count = std::min(BlockTracer::most_rays, queries.size() - begin);
    bool together = block.Begin(queries.subspan(begin, count));
    if (!together) {
      count = std::min<std::size_t>(16, count);
      together = count >= least && block.Begin(queries.subspan(begin, count));
    }
    if (together) {
      block.Trace(answers.subspan(begin, count), single, statistics);
    } else {
      trace_singly(begin, begin + count);
    }
    begin += count;
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
