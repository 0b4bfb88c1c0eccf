#include <algorithm>
#include <cmath>
#include <mutex>

#include "accel/all.h"
#include "accel/cells/cell_trace.h"
#include "accel/cells/prototype_cells.h"
#include "accel/stand_in.h"
#include "csg/classifier.h"
#include "csg/describe_hit.h"
#include "csg/make_hit.h"
#include "csg/minimum_enclosure.h"
#include "primitive/dispatch.h"
#include "tenon/base/parallel_for.h"

namespace tenon {

namespace {

using cells::CellAnswer;
using cells::CellOwner;
using cells::CellTree;

/// `cells`: space is cut until the Boolean expression in each cell is a word of truth values over a few primitives, so
/// that the first change of value in the first cell is the answer.
///
/// Rays are followed by plain arithmetic that proves its own answer: crossings nearer to each other than twice the
/// resolution (CellScale), grazing rays, rays that start in faces that they do not know of, surfaces without inside,
/// solids without end go to an exact structure, which is built when it is first asked. So the answers are those
/// of every other structure, bit for bit.
class Cells final : public Accelerator {
 public:
  Cells(const CsgTree& tree, CellTree cells) : tree_(tree), cells_(std::move(cells)) {}

  std::unique_ptr<TraceContext> make_context() const override { return std::make_unique<Context>(); }

  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& base) const override {
    auto& context = static_cast<Context&>(base);
    context.answers.resize(queries.size());
    trace(queries, cells::AnswerSink{context.answers}, context);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const CellAnswer& answer = context.answers[i];
      if (answer.kind == CellAnswer::Kind::nothing) {
        hits[i].lose();
      } else if (answer.kind == CellAnswer::Kind::unsure || !complete(queries[i], answer, hits[i], context)) {
        exact(context, [&](const Accelerator& exact, TraceContext& exact_context) {
          exact.first_hits(queries.subspan(i, 1), hits.subspan(i, 1), exact_context);
        });
      }
    }
  }

  void first_boundaries(std::span<const RayQuery> queries, std::span<RayBoundary> boundaries,
                        TraceContext& base) const override {
    auto& context = static_cast<Context&>(base);
    trace(queries, cells::BoundarySink{boundaries, context.unsure, cells_, context.scratch.runs}, context);
    ask_of_unsure(context, [&](std::size_t i, const Accelerator& exact, TraceContext& exact_context) {
      exact.first_boundaries(queries.subspan(i, 1), boundaries.subspan(i, 1), exact_context);
    });
  }

  void occluded(std::span<const RayQuery> queries, std::span<std::uint8_t> answers, TraceContext& base) const override {
    auto& context = static_cast<Context&>(base);
    trace(queries, cells::OcclusionSink{answers, context.unsure}, context);
    ask_of_unsure(context, [&](std::size_t i, const Accelerator& exact, TraceContext& exact_context) {
      exact.occluded(queries.subspan(i, 1), answers.subspan(i, 1), exact_context);
    });
  }

  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& base) const override {
    auto& context = static_cast<Context&>(base);
    if (cells_.empty()) {
      ++context.statistics[query.kind].rays;
      return false;
    }
    bool stopped = false, is_complete = true;
    double told = -std::numeric_limits<double>::infinity();
    const bool is_known = trace_all(
        cells_, tree_, query,
        [&](const CellAnswer& answer) {
          Hit hit;
          is_complete = complete(query, answer, hit, context);
          if (!is_complete) return false;
          told = hit.t;
          stopped = stops(hit);
          return !stopped;
        },
        context.scratch, context.statistics);
    if (is_known && is_complete) return stopped;
    exact(context, [&](const Accelerator& exact, TraceContext& exact_context) {
      stopped = exact.any_hit(
          query, [&](const Hit& hit) { return hit.t > told && stops(hit); }, exact_context);
    });
    return stopped;
  }

  void all_spans(const RayQuery& query, std::vector<SolidSpan>& spans, TraceContext& base) const override {
    exact(static_cast<Context&>(base),
          [&](const Accelerator& exact, TraceContext& exact_context) { exact.all_spans(query, spans, exact_context); });
  }

  AcceleratorFigures figures() const override {
    AcceleratorFigures figures{cells_.memory_bytes(), cells_.nodes.size() + cells_.cells.size(), cells_.depth, {}};
    for (const auto& [what, value] : cells_.details()) figures.details.push_back({what, value});
    const std::vector<const CellTree*> parts = trees_within(cells_);
    std::size_t part_cells = 0;
    for (const CellTree* part : parts) {
      figures.memory_bytes += part->memory_bytes();
      figures.boxes += part->nodes.size() + part->cells.size();
      part_cells += part->cells.size();
    }
    if (!parts.empty()) {
      figures.details.push_back({"parts that are stored once", static_cast<double>(parts.size())});
      figures.details.push_back({"boundary cells in them", static_cast<double>(part_cells)});
    }
    return figures;
  }

 private:
  struct Context final : TraceContext {
    cells::CellScratch scratch;
    std::vector<CellAnswer> answers;
    std::vector<std::uint32_t> unsure;  // rays of the last call, by their places
    std::unique_ptr<TraceContext> exact;
  };

  template <class Sink>
  void trace(std::span<const RayQuery> queries, const Sink& sink, Context& context) const {
    context.unsure.clear();
    if (!cells_.empty()) return trace_rays(cells_, tree_, queries, sink, context.scratch, context.statistics);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      ++context.statistics[queries[i].kind].rays;
      sink.put(i, CellAnswer{});
    }
  }

  // The boundary as the classifier would have found it; false when its material is not known here.
  bool complete(const RayQuery& query, const CellAnswer& answer, Hit& hit, Context& context) const {
    const Leaf& leaf = tree_[answer.surface.leaf];
    if (answer.run != CellAnswer::no_run) {
      Run run = context.scratch.runs[answer.run];
      if (!shows_owner(leaf, run.before, run.after)) run.owner = {};
      if (CellOwner{run.owner}.varies()) return false;
      hit = make_hit(tree_, query.ray, run);
      return true;
    }
    hit.before = cells_.medium_of(answer.cell, answer.before);
    hit.after = cells_.medium_of(answer.cell, answer.after);
    CellOwner owner;
    if (shows_owner(leaf, hit.before, hit.after)) {
      const std::uint32_t side = hit.after != medium_outside ? answer.after : answer.before;
      owner = cells_.owner_of(cells_.cells[answer.cell], side);
      if (owner.varies()) return false;
    }
    hit.t = answer.t;
    hit.bound = cells_.scale.resolution / length(query.ray.direction);
    hit.surface = answer.surface;
    hit.is_surface = false;
    hit.faces.clear();
    hit.faces.push_back(hit.surface);
    describe_hit(tree_, query.ray, answer.leaf_entering, owner.leaf, hit);
    return true;
  }

  template <class Ask>
  void exact(Context& context, const Ask& ask) const {
    std::call_once(exact_built_, [this] { exact_ = std::move(build_accelerator("multi-kd", tree_)).value(); });
    if (!context.exact) context.exact = exact_->make_context();
    ask(*exact_, *context.exact);
  }

  template <class Ask>
  void ask_of_unsure(Context& context, const Ask& ask) const {
    for (const std::uint32_t i : context.unsure) {
      exact(context, [&](const Accelerator& exact, TraceContext& exact_context) { ask(i, exact, exact_context); });
    }
  }

  const CsgTree& tree_;
  CellTree cells_;
  mutable std::once_flag exact_built_;
  mutable std::unique_ptr<Accelerator> exact_;
};

// Whether all is solid, and has an end.
bool is_plain(const CsgTree& tree, const Box3& enclosure) {
  if (!(enclosure.is_bounded() || enclosure.is_empty())) return false;
  return std::none_of(tree.leaves.begin(), tree.leaves.end(),
                      [&](const Leaf& leaf) { return is_surface(tree.primitives, leaf.primitive); });
}

// Whether there is a great deal of what has a structure of its own. A cell can make no use of what is within one, and a
// hierarchy over many takes a tenth of the memory and of the time to build (measured with 10⁵ meshes).
bool is_crowd(const CsgTree& tree) {
  constexpr std::ptrdiff_t many = 1 << 16;
  const PrimitiveKind* mesh = PrimitiveStore::find_kind("mesh");
  return std::count_if(tree.leaves.begin(), tree.leaves.end(),
                       [&](const Leaf& leaf) { return &tree.primitives.kind(leaf.primitive) == mesh; }) > many;
}

}  // namespace

Result<std::unique_ptr<Accelerator>> build_cells(const BuildInput& input, AcceleratorOptions& options) {
  cells::BuildSettings settings;
  switch (options.take_word("quality", {"default", "fast", "high"})) {
    case 1:
      settings.quality = {0, 1.0 / 4, 0};
      break;
    case 2:
      settings.quality = {5, 1.0 / 32, 1};
      break;
    default:
      break;
  }
  cells::BuildLimits& limits = settings.limits;
  limits.depth = options.take_integer("depth", limits.depth, 1, limits.depth);
  constexpr int no_limit = 0;
  const int most_cells = options.take_integer("most-cells", no_limit, 1, std::numeric_limits<int>::max());
  if (most_cells != no_limit) limits.cells = static_cast<std::size_t>(most_cells);
  settings.threads = options.take_integer("threads", available_threads(), 1, 4096);
  if (Status status = options.finish(); !status) return status.error();
  const CsgTree& tree = input.tree;
  const Box3 enclosure = tree.root ? node_enclosures(tree)[tree.root.get()] : Box3::empty();
  if (!is_plain(tree, enclosure)) {
    return stand_in(build_accelerator("multi-kd", tree, input.view),
                    "multi-kd traces it: there are surfaces, or solids without end");
  }
  if (is_crowd(tree)) {
    return stand_in(build_accelerator("goldsmith-bvh", tree, input.view),
                    "goldsmith-bvh traces it: there are very many meshes, each of which is stored once");
  }
  CellTree cells;
  if (!enclosure.is_empty()) {
    const cells::CellScale scale = cells::CellScale::of(tree);
    cells = CellTree::build(tree, enclosure, scale, settings);
    cells.prototypes = cells::build_prototype_cells(tree, scale, settings);
  }
  return std::unique_ptr<Accelerator>(std::make_unique<Cells>(tree, std::move(cells)));
}

}  // namespace tenon
