#pragma once

#include <utility>

#include "accel/walk.h"
#include "csg/make_hit.h"

namespace tenon {

/// What a new structure has to be. It holds the bounded leaves; the unbounded ones (half-spaces) are revealed before
/// traverse() is called.
///
///   Scratch                    per-thread memory; default-constructible
///   traverse(walk, scratch)    reveals leaves and settles along the ray, until Walk::settle says stop
///   memory_bytes(), boxes(), depth()   its figures
template <class S>
concept Structure = requires(const S& s, Walk& walk, typename S::Scratch& scratch) {
  s.traverse(walk, scratch);
  { s.memory_bytes() } -> std::convertible_to<std::size_t>;
  { s.boxes() } -> std::convertible_to<std::size_t>;
  { s.depth() } -> std::convertible_to<int>;
};

/// Answers the queries of an Accelerator by a structure's one traversal.
template <Structure S>
class StructureAccelerator final : public Accelerator {
 public:
  StructureAccelerator(const CsgTree& tree, S structure)
      : tree_(tree), expression_(Expression::compile(tree)), structure_(std::move(structure)) {
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
      if (!tree.leaves[i].bounds.is_bounded()) unbounded_.emplace_back(i);
    }
  }

  std::unique_ptr<TraceContext> make_context() const override { return std::make_unique<Context>(*this); }

  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& context) const override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      hits[i] = Hit{};
      follow(queries[i], context, [&](const Run& run) {
        hits[i] = make_hit(tree_, queries[i].ray, run);
        return true;
      });
    }
  }

  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const override {
    bool stopped = false;
    follow(query, context, [&](const Run& run) { return stopped = stops(make_hit(tree_, query.ray, run)); });
    return stopped;
  }

  void all_spans(const RayQuery& query, std::vector<SolidSpan>& spans, TraceContext& context) const override {
    constexpr double inf = std::numeric_limits<double>::infinity();
    spans.clear();
    bool inside = false, first = true;
    double t_in = 0;
    const MediumId end = follow(query, context, [&](const Run& run) {
      if (first) inside = run.before != medium_outside;  // then the ray starts inside, at t_in = 0
      first = false;
      const bool enters = run.after != medium_outside;
      if (enters && !inside) t_in = run.t;
      if (!enters && inside) spans.push_back({t_in, run.t});
      inside = enters;
      return false;
    });
    if (first) inside = end != medium_outside;
    if (inside) spans.push_back({t_in, query.t_max < inf ? query.t_max : inf});
  }

  AcceleratorFigures figures() const override {
    return {structure_.memory_bytes(), structure_.boxes(), structure_.depth(), {}};
  }

 private:
  struct Context final : TraceContext {
    explicit Context(const StructureAccelerator& accelerator)
        : classifier(ExpressionState(accelerator.expression_), TreeSource(accelerator.tree_),
                     accelerator.tree_.leaves.size()) {}
    TreeClassifier classifier;
    typename S::Scratch scratch;
  };

  // Follows a ray until the sink has what it wants; returns the medium at the end, if the sink never stopped it.
  MediumId follow(const RayQuery& query, TraceContext& base, Walk::Sink sink) const {
    auto& context = static_cast<Context&>(base);
    TraversalCounters& counters = context.statistics[query.kind];
    ++counters.rays;
    const std::uint64_t faults = context.classifier.seam_faults();
    context.classifier.source().set_ray(query.ray, query.from);
    context.classifier.start();
    Walk walk(context.classifier, query, counters, sink);
    for (const LeafId leaf : unbounded_) walk.reveal(leaf);
    structure_.traverse(walk, context.scratch);
    walk.finish();
    context.statistics.seam_faults += context.classifier.seam_faults() - faults;
    return walk.final_value();
  }

  const CsgTree& tree_;
  Expression expression_;
  S structure_;
  std::vector<LeafId> unbounded_;
};

}  // namespace tenon
