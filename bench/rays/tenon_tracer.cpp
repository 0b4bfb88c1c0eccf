#include "rays/tenon_tracer.h"

namespace tenon::bench {

void TenonTracer::load(const RaySet& set, int threads) {
  set_ = &set;
  answers_.assign(set.rays.size(), Answer{});
  while (workers_.size() < static_cast<std::size_t>(threads)) {
    workers_.push_back({accelerator_.make_context(), std::vector<Hit>(block)});
  }
}

void TenonTracer::trace(std::size_t begin, std::size_t end, int worker) {
  Worker& own = workers_[static_cast<std::size_t>(worker)];
  const std::span<const RayQuery> queries(set_->rays.data() + begin, end - begin);
  if (set_->kind == RayKind::shadow) {
    const auto opaque = [](const Hit&) { return true; };
    for (std::size_t i = 0; i < queries.size(); ++i) {
      answers_[begin + i].hit = accelerator_.any_hit(queries[i], opaque, *own.context);
    }
    return;
  }
  const std::span<Hit> hits(own.hits.data(), queries.size());
  accelerator_.first_hits(queries, hits, *own.context);
  for (std::size_t i = 0; i < queries.size(); ++i) answers_[begin + i] = {hits[i].found(), hits[i].t, hits[i].normal};
}

void TenonTracer::unload() {
  set_ = nullptr;
  answers_ = {};
}

}  // namespace tenon::bench
