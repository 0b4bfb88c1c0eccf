#include "rays/tenon_tracer.h"

#include <algorithm>

namespace tenon::bench {

void TenonTracer::load(const RaySet& set, int threads) {
  set_ = &set;
  boundaries_.assign(set.rays.size(), RayBoundary{});
  occluded_.assign(set.rays.size(), 0);
  while (contexts_.size() < static_cast<std::size_t>(threads)) contexts_.push_back(accelerator_.make_context());
}

void TenonTracer::trace(std::size_t begin, std::size_t end, int worker) {
  TraceContext& context = *contexts_[static_cast<std::size_t>(worker)];
  for (; begin < end; begin += batch_) {
    const std::size_t count = std::min(batch_, end - begin);
    const std::span<const RayQuery> queries(set_->rays.data() + begin, count);
    if (set_->kind == RayKind::shadow) {
      accelerator_.occluded(queries, {occluded_.data() + begin, count}, context);
    } else {
      accelerator_.first_boundaries(queries, {boundaries_.data() + begin, count}, context);
    }
  }
}

std::vector<Answer> TenonTracer::answers() const {
  std::vector<Answer> answers(boundaries_.size());
  for (std::size_t i = 0; i < answers.size(); ++i) {
    if (set_->kind == RayKind::shadow) {
      answers[i].hit = occluded_[i] != 0;
    } else if (boundaries_[i].found()) {
      answers[i] = {true, boundaries_[i].t};
    }
  }
  return answers;
}

Vec3 TenonTracer::normal(std::size_t ray) const {
  return accelerator_.first_hit(set_->rays[ray], *contexts_.front()).normal;
}

void TenonTracer::unload() {
  set_ = nullptr;
  boundaries_ = {};
  occluded_ = {};
}

}  // namespace tenon::bench
