#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "tenon/accel/accelerator.h"

namespace tenon {

/// A ball.
struct AnalyticBall {
  Vec3 center;
  double radius = 1;
};
/// Everything with lower <= z <= upper.
struct AnalyticSlab {
  double lower = 0, upper = 1;
};

struct AnalyticSolid {
  std::variant<AnalyticBall, AnalyticSlab> shape;
  MaterialId material;
  MediumId medium = medium_opaque;
};

/// Solids that do not touch each other, met by textbook formulas: a renderer's world without a classifier in it.
class AnalyticAccelerator final : public Accelerator {
 public:
  explicit AnalyticAccelerator(std::vector<AnalyticSolid> solids) : solids_(std::move(solids)) {}

  std::unique_ptr<TraceContext> make_context() const override { return std::make_unique<Context>(); }

  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& context) const override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      const std::vector<Hit> all = boundaries(queries[i], context);
      hits[i] = all.empty() ? Hit{} : all.front();
    }
  }

  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const override {
    std::vector<Hit> all = boundaries(query, context);
    if (reversed_) std::reverse(all.begin(), all.end());
    for (const Hit& hit : all) {
      if (stops(hit)) return true;
    }
    return false;
  }

  void all_spans(const RayQuery&, std::vector<SolidSpan>&, TraceContext&) const override {}
  AcceleratorFigures figures() const override { return {}; }

  /// Shadow rays learn of boundaries from the far end.
  void reverse_shadow_order() { reversed_ = true; }

 private:
  struct Context final : TraceContext {};

  std::vector<Hit> boundaries(const RayQuery& query, TraceContext& context) const {
    ++context.statistics[query.kind].rays;
    std::vector<Hit> hits;
    for (std::size_t i = 0; i < solids_.size(); ++i) {
      if (const auto* ball = std::get_if<AnalyticBall>(&solids_[i].shape)) {
        add_ball(*ball, i, query, hits);
      } else {
        add_slab(std::get<AnalyticSlab>(solids_[i].shape), i, query, hits);
      }
    }
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
    return hits;
  }

  static bool starts_on(const RayQuery& query, std::size_t leaf, std::uint32_t face) {
    return query.from != nullptr && query.from->surface == LeafFace{LeafId{leaf}, face};
  }

  void add(std::size_t leaf, std::uint32_t face, double t, const Vec3& outward, const RayQuery& query,
           std::vector<Hit>& hits) const {
    if (!(t > 0) || !(t < query.t_max)) return;
    Hit hit;
    hit.t = t;
    hit.point = query.ray.at(t);
    hit.normal = normalize(outward);
    hit.surface = {LeafId{leaf}, face};
    hit.material = solids_[leaf].material;
    hit.entering = dot(outward, query.ray.direction) < 0;
    hit.before = hit.entering ? medium_outside : solids_[leaf].medium;
    hit.after = hit.entering ? solids_[leaf].medium : medium_outside;
    hits.push_back(hit);
  }

  void add_ball(const AnalyticBall& ball, std::size_t leaf, const RayQuery& query, std::vector<Hit>& hits) const {
    const Vec3 d = query.ray.direction, oc = query.ray.origin - ball.center;
    const double a = dot(d, d), b = dot(d, oc), c = dot(oc, oc) - ball.radius * ball.radius;
    const auto add_root = [&](double t) { add(leaf, 0, t, query.ray.at(t) - ball.center, query, hits); };
    if (starts_on(query, leaf, 0)) {
      add_root(-2 * b / a);
      return;
    }
    const double discriminant = b * b - a * c;
    if (discriminant <= 0) return;
    add_root((-b - std::sqrt(discriminant)) / a);
    add_root((-b + std::sqrt(discriminant)) / a);
  }

  void add_slab(const AnalyticSlab& slab, std::size_t leaf, const RayQuery& query, std::vector<Hit>& hits) const {
    const double dz = query.ray.direction.z, oz = query.ray.origin.z;
    if (dz == 0) return;
    if (!starts_on(query, leaf, 0)) add(leaf, 0, (slab.lower - oz) / dz, {0, 0, -1}, query, hits);
    if (!starts_on(query, leaf, 1)) add(leaf, 1, (slab.upper - oz) / dz, {0, 0, 1}, query, hits);
  }

  std::vector<AnalyticSolid> solids_;
  bool reversed_ = false;
};

}  // namespace tenon
