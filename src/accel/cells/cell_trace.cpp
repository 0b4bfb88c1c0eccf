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
  // Fewer rays are sooner traced one by one (by trial on the bench).
  constexpr std::size_t least = 8;
  if (queries.size() < least) return trace_singly(0, queries.size());
  BlockTracer block(cells, tree.tolerance.distance);
  // Where many do not make a block that pays, fewer of them may.
  constexpr std::size_t few = 16;
  std::size_t most = BlockTracer::most_rays;
  for (std::size_t begin = 0; begin < queries.size();) {
    std::size_t count = std::min(most, queries.size() - begin);
    bool together = most >= least && block.Begin(queries.subspan(begin, count));
    if (!together && count > few) {
      count = few;
      together = block.Begin(queries.subspan(begin, count));
    }
    if (!together) {
      trace_singly(begin, begin + count);
    } else if (!block.Trace(answers.subspan(begin, count), single, statistics)) {
      most = most > few ? few : 1;
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
