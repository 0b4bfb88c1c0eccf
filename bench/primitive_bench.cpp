#include <benchmark/benchmark.h>

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "primitive/dispatch.h"

/// Time per call of spans() and classify(), for every kind with its fallback values, rays and boxes spread over its
/// bounds. The cost that the surface area heuristic uses (SolidPrimitive::relative_cost) comes from here.
namespace tenon {
namespace {

// A primitive of a kind with its fallback values, turned in the world.
struct Subject {
  PrimitiveStore store;
  PrimitiveId id;
  Box3 bounds;
  Placement placement;

  static Subject create(const PrimitiveKind& kind) {
    PrimitiveStore store;
    std::vector<FieldValue> values;
    for (const FieldInfo& field : kind.fields) values.push_back(field.fallback);
    const PrimitiveId id = *store.add(kind, values);
    const Box3 bounds = kind.bounded ? local_bounds(store, id) : Box3{{-1, -1, -1}, {1, 1, 1}};
    const auto placement =
        Placement::create(BoundedAffine3::elementary(Affine3::rotate({10, 20, 30})), bounds.center());
    return {std::move(store), id, bounds, *placement};
  }
  Vec3 point(std::mt19937_64& random) const { return bounds.center() + 0.6 * bounds.size() * in_cube(random); }

  static Vec3 in_cube(std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(random), y = uniform(random);
    return {x, y, uniform(random)};
  }
};

enum class Asked { line, ray_of_world, window };

// A window is where the ray crosses a surface, if anywhere, and hardly more.
LineWindow window_of(const Subject& subject, const LocalRay& ray, std::mt19937_64& random) {
  const double edge = max_component(subject.bounds.size());
  Spans out;
  spans(subject.store, subject.id, ray, out);
  const double t =
      out.empty() || !std::isfinite(out.front().t) ? edge * Subject::in_cube(random).x : out[random() % out.size()].t;
  return {t - 0x1p-10 * edge, t + 0x1p-10 * edge};
}

void measure_spans(benchmark::State& state, const PrimitiveKind& kind, Asked asked) {
  const bool placed = asked == Asked::ray_of_world;
  const Subject subject = Subject::create(kind);
  const Affine3& map = subject.placement.world_from_local();
  std::mt19937_64 random(1);
  std::vector<Ray> rays(4096);
  for (Ray& ray : rays) {
    ray.direction = normalize(Subject::in_cube(random));
    ray.origin = subject.point(random);
    if (placed) ray = {map.point(ray.origin) - 3 * map.direction(ray.direction), map.direction(ray.direction)};
  }
  std::vector<LineWindow> windows;
  if (asked == Asked::window) {
    for (const Ray& ray : rays) {
      windows.push_back(window_of(subject, {ray.origin, ray.direction, {}, {}, -1}, random));
    }
  }
  Spans out;
  std::size_t i = 0, crossings = 0;
  for ([[maybe_unused]] auto _ : state) {
    const std::size_t at = i++ % rays.size();
    const Ray& ray = rays[at];
    out.clear();
    if (placed) {
      spans(subject.store, subject.id, subject.placement, ray, 1e-12, -1, out);
    } else if (asked == Asked::window) {
      spans_within(subject.store, subject.id, {{ray.origin, ray.direction, {}, {}, -1}, 0}, windows[at], out);
    } else {
      spans(subject.store, subject.id, {ray.origin, ray.direction, {}, {}, -1}, out);
    }
    crossings += out.size();
    benchmark::DoNotOptimize(out.data());
  }
  state.counters["crossings"] = static_cast<double>(crossings) / static_cast<double>(i);
}

void measure_classify(benchmark::State& state, const PrimitiveKind& kind) {
  const Subject subject = Subject::create(kind);
  std::mt19937_64 random(1);
  std::vector<LocalBox> boxes(4096);
  for (LocalBox& box : boxes) {
    const Vec3 center = subject.placement.world_from_local().point(subject.point(random));
    const Vec3 half = 0.1 * max_component(subject.bounds.size()) * (Subject::in_cube(random) + Vec3{1.1, 1.1, 1.1});
    box = subject.placement.to_local(Box3{center - half, center + half});
  }
  std::size_t i = 0, certain = 0;
  for ([[maybe_unused]] auto _ : state) {
    certain += classify(subject.store, subject.id, boxes[i++ % boxes.size()]) != Region::straddles;
  }
  state.counters["certain"] = static_cast<double>(certain) / static_cast<double>(i);
}

[[maybe_unused]] const bool registered = [] {
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    const std::string name(kind.name);
    const auto measure = [&](const char* what, Asked asked) {
      benchmark::RegisterBenchmark((what + name).c_str(),
                                   [&kind, asked](benchmark::State& s) { measure_spans(s, kind, asked); });
    };
    measure("spans/", Asked::line);
    measure("placed_spans/", Asked::ray_of_world);
    measure("spans_within/", Asked::window);
    benchmark::RegisterBenchmark(("classify/" + name).c_str(),
                                 [&kind](benchmark::State& s) { measure_classify(s, kind); });
  }
  return true;
}();

}  // namespace
}  // namespace tenon
