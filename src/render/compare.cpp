#include "tenon/render/compare.h"

#include <algorithm>

#include "render/lit_scene.h"
#include "tenon/base/timing.h"

namespace tenon {

namespace {

// Whether light ends at a boundary, as the illumination model has it; counts those it passes.
class Shadow {
 public:
  explicit Shadow(const LitScene& scene) : scene_(scene) {}
  StoredAnswer trace(const Accelerator& accelerator, const RayQuery& query, TraceContext& context) const {
    StoredAnswer answer;
    const auto stops = [&](const Hit& boundary) {
      if (!(scene_.reflectance(boundary.material).transmitted > 0)) return true;
      ++answer.passed;
      return false;
    };
    answer.stopped = accelerator.any_hit(query, stops, context);
    // How many transparent boundaries are met before an opaque one is left open.
    if (answer.stopped) answer.passed = 0;
    return answer;
  }

 private:
  const LitScene& scene_;
};

// Answers as the oracle does, and keeps what it was asked.
class Recorder final : public Accelerator {
 public:
  Recorder(const Accelerator& oracle, const LitScene& scene, StoredRays& rays)
      : oracle_(oracle), shadow_(scene), rays_(rays) {}

  std::unique_ptr<TraceContext> make_context() const override { return oracle_.make_context(); }
  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& context) const override {
    oracle_.first_hits(queries, hits, context);
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const bool is_shadow = queries[i].kind == RayKind::shadow;
      rays_.add(queries[i], is_shadow ? shadow_.trace(oracle_, queries[i], context) : StoredAnswer{hits[i]});
    }
  }
  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const override {
    rays_.add(query, shadow_.trace(oracle_, query, context));
    return oracle_.any_hit(query, stops, context);
  }
  bool answers_piecewise() const override { return oracle_.answers_piecewise(); }
  void all_spans(const RayQuery& query, std::vector<SolidSpan>& spans, TraceContext& context) const override {
    oracle_.all_spans(query, spans, context);
  }
  AcceleratorFigures figures() const override { return oracle_.figures(); }

 private:
  const Accelerator& oracle_;
  Shadow shadow_;
  StoredRays& rays_;
};

bool same_answer(const StoredAnswer& a, const StoredAnswer& b) {
  return same_hit(a.hit, b.hit) && a.stopped == b.stopped && a.passed == b.passed;
}

// Rays are traced in blocks of this many, small enough for the answers to stay in a cache.
constexpr std::size_t block = 256;

class Replayer {
 public:
  Replayer(const Scene& scene, const Accelerator& accelerator)
      : accelerator_(accelerator), lit_(scene), shadow_(lit_), context_(accelerator.make_context()) {}

  void trace(std::span<const RayQuery> queries, std::span<const StoredAnswer> expected) {
    found_.assign(queries.size(), StoredAnswer{});
    hits_.resize(queries.size());
    const double begun = thread_cpu_seconds();
    if (queries.front().kind == RayKind::shadow) {
      for (std::size_t i = 0; i < queries.size(); ++i) found_[i] = shadow_.trace(accelerator_, queries[i], *context_);
    } else {
      accelerator_.first_hits(queries, hits_, *context_);
    }
    result_.seconds += thread_cpu_seconds() - begun;
    if (queries.front().kind != RayKind::shadow) {
      for (std::size_t i = 0; i < queries.size(); ++i) found_[i].hit = hits_[i];
    }
    for (std::size_t i = 0; i < queries.size(); ++i) {
      if (same_answer(expected[i], found_[i])) continue;
      if (result_.mismatches++ == 0) result_.first = Mismatch{queries[i], expected[i], found_[i]};
    }
  }

  Replay finish() {
    result_.statistics = context_->statistics;
    return std::move(result_);
  }

 private:
  const Accelerator& accelerator_;
  LitScene lit_;
  Shadow shadow_;
  std::unique_ptr<TraceContext> context_;
  std::vector<Hit> hits_;
  std::vector<StoredAnswer> found_;
  Replay result_;
};

}  // namespace

bool same_hit(const Hit& a, const Hit& b) {
  if (!a.found() || !b.found()) return a.found() == b.found();
  if (a.faces.size() != b.faces.size()) return false;
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    if (a.faces[i] != b.faces[i]) return false;
  }
  return a.t == b.t && a.point == b.point && a.normal == b.normal && a.surface == b.surface &&
         a.material == b.material && a.entering == b.entering && a.is_surface == b.is_surface && a.before == b.before &&
         a.after == b.after;
}

std::size_t StoredRays::size() const {
  std::size_t count = 0;
  for (const auto& queries : queries_) count += queries.size();
  return count;
}

void StoredRays::add(const RayQuery& query, const StoredAnswer& answer) {
  const auto kind = static_cast<std::size_t>(query.kind);
  queries_[kind].push_back(query);
  if (query.from != nullptr) {
    starts_.push_back(*query.from);
    queries_[kind].back().from = &starts_.back();
  }
  answers_[kind].push_back(answer);
}

Result<StoredRays> StoredRays::record(const Scene& scene, const Accelerator& oracle, RenderOptions options,
                                      ProgressCounters* progress) {
  StoredRays rays;
  const LitScene lit(scene);
  const Recorder recorder(oracle, lit, rays);
  options.threads = 1;
  const Result<Rendering> rendering = render(scene, recorder, options, {.progress = progress});
  if (!rendering) return rendering.error();
  return rays;
}

Replay replay(const Scene& scene, const Accelerator& accelerator, const StoredRays& rays, ProgressCounters* progress) {
  Replayer replayer(scene, accelerator);
  if (progress != nullptr) progress->total = rays.size();
  for (std::size_t kind = 0; kind < ray_kind_count; ++kind) {
    const std::span<const RayQuery> queries = rays.queries(static_cast<RayKind>(kind));
    const std::span<const StoredAnswer> answers = rays.answers(static_cast<RayKind>(kind));
    for (std::size_t begin = 0; begin < queries.size(); begin += block) {
      const std::size_t size = std::min(block, queries.size() - begin);
      replayer.trace(queries.subspan(begin, size), answers.subspan(begin, size));
      if (progress == nullptr) continue;
      progress->done += size;
      progress->rays += size;
    }
  }
  return replayer.finish();
}

}  // namespace tenon
