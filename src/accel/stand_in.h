#pragma once

#include <memory>
#include <string>
#include <utility>

#include "tenon/accel/accelerator.h"

namespace tenon {

/// A structure that does the work of the one that was asked for, and says so.
class StandIn final : public Accelerator {
 public:
  StandIn(std::unique_ptr<Accelerator> structure, std::string note)
      : structure_(std::move(structure)), note_(std::move(note)) {}

  std::unique_ptr<TraceContext> make_context() const override { return structure_->make_context(); }

  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& context) const override {
    structure_->first_hits(queries, hits, context);
  }
  void first_boundaries(std::span<const RayQuery> queries, std::span<RayBoundary> boundaries,
                        TraceContext& context) const override {
    structure_->first_boundaries(queries, boundaries, context);
  }
  void occluded(std::span<const RayQuery> queries, std::span<std::uint8_t> answers,
                TraceContext& context) const override {
    structure_->occluded(queries, answers, context);
  }
  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const override {
    return structure_->any_hit(query, stops, context);
  }
  bool answers_piecewise() const override { return structure_->answers_piecewise(); }
  void all_spans(const RayQuery& query, std::vector<SolidSpan>& spans, TraceContext& context) const override {
    structure_->all_spans(query, spans, context);
  }

  AcceleratorFigures figures() const override {
    AcceleratorFigures figures = structure_->figures();
    figures.note = note_;
    return figures;
  }

 private:
  std::unique_ptr<Accelerator> structure_;
  std::string note_;
};

/// @param built  the structure that is used
/// @param note   which it is, and why
inline Result<std::unique_ptr<Accelerator>> stand_in(Result<std::unique_ptr<Accelerator>> built, std::string note) {
  if (!built) return built.error();
  return std::unique_ptr<Accelerator>(std::make_unique<StandIn>(std::move(*built), std::move(note)));
}

}  // namespace tenon
