#pragma once

#include <deque>
#include <string>

#include "accel/gallery.h"

/// What every structure signs: the same answers as another accelerator, bit for bit.
namespace tenon::battery {

using fixtures::Draw;

/// Rays, and the hits that some of them start at.
struct RaySet {
  std::vector<RayQuery> queries;
  std::deque<Hit> starts;  // stays in place as it grows

  void add(const Vec3& origin, const Vec3& direction, double t_max = std::numeric_limits<double>::infinity()) {
    RayQuery query;
    query.ray = {origin, direction};
    query.t_max = t_max;
    query.kind = RayKind::diffuse;
    queries.push_back(query);
  }
};

/// Where the scene's solids are; the unit box when none has an end.
inline Box3 extent(const CsgTree& tree) {
  Box3 box;
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.bounds.is_bounded()) box = hull(box, leaf.bounds);
  }
  return box.is_empty() ? Box3{{-1, -1, -1}, {1, 1, 1}} : box;
}

/// Rays through the scene: from everywhere, from inside, along axes, in faces, through edges and corners, from afar;
/// and from the first hits of those, in every direction.
inline RaySet make_rays(const CsgTree& tree, const Accelerator& reference, int count, std::uint64_t seed) {
  Draw draw(seed);
  RaySet rays;
  const Box3 box = extent(tree);
  const Vec3 center = box.center();
  const double radius = 0.5 * length(box.size());
  // A corner of a leaf: its faces, edges and corners lie there.
  const auto corner = [&] {
    if (tree.leaves.empty()) return box.lower;
    const Box3& b = tree.leaves[static_cast<std::size_t>(draw.below(static_cast<int>(tree.leaves.size())))].bounds;
    const Vec3 p{draw.one_in(2) ? b.lower.x : b.upper.x, draw.one_in(2) ? b.lower.y : b.upper.y,
                 draw.one_in(2) ? b.lower.z : b.upper.z};
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) ? p : center;
  };
  const auto axis_direction = [&] {
    Vec3 d;
    d[draw.below(3)] = draw.one_in(2) ? 1 : -1;
    return d;
  };
  const Vec3 eye = center + draw.direction() * (2.5 * radius);
  for (int i = 0; i < count; ++i) {
    const Vec3 outside = center + draw.direction() * (2 * radius);
    const Vec3 inside = draw.in_box(box);
    rays.add(outside, inside - outside);
    rays.add(outside, (inside - outside) * draw.real(1e-3, 1e3), draw.real(0, 2));
    rays.add(eye, normalize(inside - eye));
    rays.add(inside, draw.direction());
    rays.add(inside, draw.direction(), draw.real(0, radius));
    rays.add(inside, axis_direction());
    const Vec3 axis = axis_direction();
    rays.add(inside - axis * (3 * radius), axis);
    const Vec3 at = corner();
    rays.add(at - axis * (2 * radius), axis);  // along an edge, in two faces
    rays.add(at, axis_direction());            // starting in faces
    rays.add(outside, at - outside);           // through a corner
    Vec3 in_face = draw.direction();
    in_face[draw.below(3)] = 0;
    rays.add(at + in_face * radius, -in_face);  // in a face
    rays.add(center + draw.direction() * (300 * radius), {}, 0.0);
    rays.queries.back().ray.direction = inside - rays.queries.back().ray.origin;
    rays.queries.back().t_max = std::numeric_limits<double>::infinity();
  }
  const auto context = reference.make_context();
  const std::size_t first_rays = rays.queries.size();
  for (std::size_t i = 0; i < first_rays; ++i) {
    const Hit hit = reference.first_hit(rays.queries[i], *context);
    if (!hit.found()) continue;
    rays.starts.push_back(hit);
    if (draw.one_in(2)) {
      rays.add(hit.point, draw.direction());
    } else {
      rays.add(hit.point, draw.in_box(box) - hit.point, 1);
    }
    rays.queries.back().from = &rays.starts.back();
  }
  return rays;
}

inline bool same_hit(const Hit& a, const Hit& b) {
  if (a.found() != b.found()) return false;
  if (!a.found()) return true;
  if (a.faces.size() != b.faces.size()) return false;
  for (std::size_t i = 0; i < a.faces.size(); ++i) {
    if (a.faces[i] != b.faces[i]) return false;
  }
  return a.t == b.t && a.point == b.point && a.normal == b.normal && a.surface == b.surface &&
         a.material == b.material && a.entering == b.entering && a.is_surface == b.is_surface && a.before == b.before &&
         a.after == b.after;
}

inline std::string describe(const Hit& h) {
  if (!h.found()) return "nothing";
  char text[200];
  std::snprintf(text, sizeof text, "t=%a (%.9g) bound=%.3g leaf=%u face=%u %s %u->%u material=%d faces:", h.t, h.t,
                h.bound, h.surface.leaf.get(), h.surface.face, h.entering ? "entering" : "leaving", h.before, h.after,
                h.material ? static_cast<int>(h.material.get()) : -1);
  std::string all = text;
  for (std::size_t i = 0; i < h.faces.size(); ++i) {
    all += ' ' + std::to_string(h.faces[i].leaf.get()) + '/' + std::to_string(h.faces[i].face);
  }
  return all;
}

inline std::string describe(const RayQuery& q) {
  char text[300];
  std::snprintf(text, sizeof text, "ray %a %a %a  %a %a %a t_max=%g%s", q.ray.origin.x, q.ray.origin.y, q.ray.origin.z,
                q.ray.direction.x, q.ray.direction.y, q.ray.direction.z, q.t_max, q.from != nullptr ? " from " : "");
  return q.from != nullptr ? text + describe(*q.from) : text;
}

struct Verdict {
  std::size_t rays = 0;
  std::size_t hits = 0;
  std::size_t mismatches = 0;
  std::uint64_t seam_faults = 0;
  std::string first;  // the first mismatch
};

/// Every boundary on the way, nearest first: any_hit reports them in any order.
inline std::vector<Hit> all_hits(const Accelerator& accelerator, const RayQuery& query, TraceContext& context) {
  std::vector<Hit> hits;
  const auto collect = [&](const Hit& hit) {
    hits.push_back(hit);
    return false;
  };
  EXPECT_FALSE(accelerator.any_hit(query, collect, context));
  std::stable_sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.t < b.t; });
  return hits;
}

inline Verdict judge(const Accelerator& reference, const Accelerator& judged, const RaySet& rays) {
  Verdict verdict;
  const auto context = reference.make_context(), other = judged.make_context();
  std::vector<Hit> hits(rays.queries.size());
  judged.first_hits(rays.queries, hits, *other);
  std::vector<SolidSpan> spans, other_spans;
  for (std::size_t i = 0; i < rays.queries.size(); ++i) {
    const RayQuery& query = rays.queries[i];
    ++verdict.rays;
    std::string difference;
    const Hit hit = reference.first_hit(query, *context);
    verdict.hits += hit.found();
    if (!same_hit(hit, hits[i])) difference = "first_hit: " + describe(hit) + "\n  against " + describe(hits[i]);

    const std::vector<Hit> way = all_hits(reference, query, *context), other_way = all_hits(judged, query, *other);
    if (!std::equal(way.begin(), way.end(), other_way.begin(), other_way.end(), same_hit)) {
      difference +=
          "\n  any_hit: " + std::to_string(way.size()) + " boundaries against " + std::to_string(other_way.size());
      for (std::size_t k = 0; k < std::max(way.size(), other_way.size()); ++k) {
        const Hit a = k < way.size() ? way[k] : Hit{}, b = k < other_way.size() ? other_way[k] : Hit{};
        if (!same_hit(a, b)) {
          difference += "\n    " + describe(a) + "\n    against " + describe(b);
          break;
        }
      }
    }
    if (judged.any_hit(
            query, [](const Hit&) { return true; }, *other) != hit.found())
      difference += "\n  any_hit, stopped";

    reference.all_spans(query, spans, *context);
    judged.all_spans(query, other_spans, *other);
    if (spans != other_spans) difference += "\n  all_spans";

    if (difference.empty()) continue;
    if (verdict.mismatches++ == 0) verdict.first = describe(query) + "\n  " + difference;
  }
  verdict.seam_faults = other->statistics.seam_faults;
  return verdict;
}

}  // namespace tenon::battery
