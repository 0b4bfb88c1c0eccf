#include "tenon/accel/section_light.h"

#include <algorithm>
#include <utility>

namespace tenon {

namespace {

class SectionLight final : public Accelerator {
 public:
  SectionLight(std::unique_ptr<Accelerator> cut, std::unique_ptr<Accelerator> whole, LeafId first_plane)
      : cut_(std::move(cut)), whole_(std::move(whole)), first_plane_(first_plane) {}

  std::unique_ptr<TraceContext> make_context() const override {
    return std::make_unique<Context>(cut_->make_context(), whole_->make_context());
  }

  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& context) const override {
    in_stretches(queries, context, [&](const Accelerator& side, std::size_t begin, std::size_t count, TraceContext& c) {
      side.first_hits(queries.subspan(begin, count), hits.subspan(begin, count), c);
    });
  }

  void first_boundaries(std::span<const RayQuery> queries, std::span<RayBoundary> boundaries,
                        TraceContext& context) const override {
    in_stretches(queries, context, [&](const Accelerator& side, std::size_t begin, std::size_t count, TraceContext& c) {
      side.first_boundaries(queries.subspan(begin, count), boundaries.subspan(begin, count), c);
    });
  }

  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const override {
    bool stopped = false;
    in_stretches({&query, 1}, context, [&](const Accelerator& side, std::size_t, std::size_t, TraceContext& c) {
      stopped = side.any_hit(query, stops, c);
    });
    return stopped;
  }

  void occluded(std::span<const RayQuery> queries, std::span<std::uint8_t> answers,
                TraceContext& context) const override {
    in_stretches(queries, context, [&](const Accelerator& side, std::size_t begin, std::size_t count, TraceContext& c) {
      side.occluded(queries.subspan(begin, count), answers.subspan(begin, count), c);
    });
  }

  // Where a ray begins decides who answers it.
  bool answers_piecewise() const override { return false; }

  void all_spans(const RayQuery& query, std::vector<SolidSpan>& spans, TraceContext& context) const override {
    in_stretches({&query, 1}, context, [&](const Accelerator& side, std::size_t, std::size_t, TraceContext& c) {
      side.all_spans(query, spans, c);
    });
  }

  AcceleratorFigures figures() const override {
    AcceleratorFigures figures = cut_->figures();
    const AcceleratorFigures whole = whole_->figures();
    figures.memory_bytes += whole.memory_bytes;
    figures.boxes += whole.boxes;
    figures.depth = std::max(figures.depth, whole.depth);
    return figures;
  }

 private:
  struct Context final : TraceContext {
    Context(std::unique_ptr<TraceContext> of_cut, std::unique_ptr<TraceContext> of_whole)
        : cut(std::move(of_cut)), whole(std::move(of_whole)) {}
    std::unique_ptr<TraceContext> cut, whole;
  };

  // Rays that carry light from lamps, or from wherever it was scattered: both must see one world, for an integrator may
  // weigh the one against the other.
  bool belongs_to_whole(const RayQuery& query) const {
    if (query.kind != RayKind::shadow && query.kind != RayKind::diffuse) return false;
    return query.from == nullptr || query.from->surface.leaf < first_plane_;
  }

  // Hands each stretch of queries of one side to its accelerator.
  template <class Ask>
  void in_stretches(std::span<const RayQuery> queries, TraceContext& base, const Ask& ask) const {
    auto& context = static_cast<Context&>(base);
    for (std::size_t begin = 0; begin < queries.size();) {
      const bool to_whole = belongs_to_whole(queries[begin]);
      std::size_t end = begin + 1;
      while (end < queries.size() && belongs_to_whole(queries[end]) == to_whole) ++end;
      ask(to_whole ? *whole_ : *cut_, begin, end - begin, to_whole ? *context.whole : *context.cut);
      begin = end;
    }
    context.statistics = context.cut->statistics;
    context.statistics += context.whole->statistics;
  }

  std::unique_ptr<Accelerator> cut_, whole_;
  LeafId first_plane_;
};

}  // namespace

std::unique_ptr<Accelerator> light_of_the_whole(std::unique_ptr<Accelerator> cut, std::unique_ptr<Accelerator> whole,
                                                LeafId first_plane) {
  return std::make_unique<SectionLight>(std::move(cut), std::move(whole), first_plane);
}

}  // namespace tenon
