#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "render/path.h"

namespace tenon {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double reflectance = 0.6, radiance_of_lamp = 2;

// The inside of the unit cube. Its faces are numbered by axis, the one at 0 before the one at 1.
class Room final : public Accelerator {
 public:
  std::unique_ptr<TraceContext> make_context() const override { return std::make_unique<Context>(); }

  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext&) const override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      hits[i] = Hit{};
      for (int axis = 0; axis < 3; ++axis) {
        const double d = queries[i].ray.direction[axis];
        const double wall = d > 0 ? 1 : 0, t = (wall - queries[i].ray.origin[axis]) / d;
        if (d == 0 || !(t > 0) || t >= hits[i].t || t >= queries[i].t_max) continue;
        if (queries[i].from != nullptr && queries[i].from->point[axis] == wall) continue;
        hits[i].t = t;
        hits[i].normal = {};
        hits[i].normal[axis] = d > 0 ? -1 : 1;
        hits[i].entering = true;
        hits[i].after = medium_opaque;
        hits[i].point = queries[i].ray.at(t);
        hits[i].point[axis] = wall;
      }
    }
  }
  bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const override {
    const Hit hit = first_hit(query, context);
    return hit.found() && stops(hit);
  }
  void all_spans(const RayQuery&, std::vector<SolidSpan>&, TraceContext&) const override {}
  AcceleratorFigures figures() const override { return {}; }

 private:
  struct Context final : TraceContext {};
};

// The share of a small surface's light that reaches a rectangle, by Lambert's formula of its contour (1760).
double form_factor(const Vec3& point, const Vec3& normal, const std::array<Vec3, 4>& corners) {
  Vec3 sum;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 a = normalize(corners[i] - point), b = normalize(corners[(i + 1) % 4] - point);
    const Vec3 c = cross(a, b);
    const double sin = length(c);
    if (sin > 0) sum += std::atan2(sin, dot(a, b)) / sin * c;
  }
  return std::fabs(dot(normal, sum)) / (2 * pi);
}

struct Patch {
  int axis, side;
  std::array<Vec3, 4> corners;
  Vec3 center, normal;
  double radiosity = 0;
};

std::vector<Patch> patches_of_face(int axis, int side, int n) {
  std::vector<Patch> patches;
  Vec3 normal;
  normal[axis] = side == 0 ? 1 : -1;
  const auto place = [&](double u, double v) {
    Vec3 p;
    p[axis] = side;
    p[(axis + 1) % 3] = u;
    p[(axis + 2) % 3] = v;
    return p;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double u = static_cast<double>(i) / n, v = static_cast<double>(j) / n, s = 1.0 / n;
      patches.push_back({axis,
                         side,
                         {place(u, v), place(u + s, v), place(u + s, v + s), place(u, v + s)},
                         place(u + s / 2, v + s / 2),
                         normal,
                         0});
    }
  }
  return patches;
}

// Classical radiosity (Goral et al. 1984): the lamp is the whole ceiling, the other faces are cut into patches.
class Radiosity {
 public:
  Radiosity() {
    constexpr int n = 12;
    lamp_ = patches_of_face(2, 1, 1).front().corners;
    for (const auto& [axis, side] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}, {2, 0}}) {
      for (const Patch& p : patches_of_face(axis, side, n)) patches_.push_back(p);
    }
    std::vector<double> factors;
    for (const Patch& to : patches_) {
      for (const Patch& from : patches_) {
        const bool same = to.axis == from.axis && to.side == from.side;
        factors.push_back(same ? 0 : form_factor(to.center, to.normal, from.corners));
      }
    }
    for (int round = 0; round < 40; ++round) {
      for (std::size_t i = 0; i < patches_.size(); ++i) {
        double sum = radiance_of_lamp * form_factor(patches_[i].center, patches_[i].normal, lamp_);
        for (std::size_t j = 0; j < patches_.size(); ++j)
          sum += factors[i * patches_.size() + j] * patches_[j].radiosity;
        patches_[i].radiosity = reflectance * sum;
      }
    }
  }

  // As radiance.
  double at(const Vec3& point, int axis, int side) const {
    Vec3 normal;
    normal[axis] = side == 0 ? 1 : -1;
    double sum = radiance_of_lamp * form_factor(point, normal, lamp_);
    for (const Patch& p : patches_) {
      if (p.axis != axis || p.side != side) sum += p.radiosity * form_factor(point, normal, p.corners);
    }
    return reflectance * sum;
  }

 private:
  std::array<Vec3, 4> lamp_;
  std::vector<Patch> patches_;
};

// What the patches leave out, and 5 standard deviations of the mean, which a good picture exceeds once in 2e6 places.
TEST(CornellBox, IsThePictureOfRadiosity) {
  Scene scene;
  scene.default_material.kd = reflectance;
  scene.default_material.ks = 0;
  scene.default_material.color = Rgba{1, 1, 1, 1};
  Light lamp;
  lamp.kind = LightKind::rectangle;
  lamp.position = {0.5, 0.5, 1 - 1e-6};
  lamp.direction = {0, 0, -1};
  lamp.intensity = radiance_of_lamp;
  scene.lights = {lamp};
  const LitScene lit(scene);
  const Room room;
  const auto context = room.make_context();
  const Radiosity reference;
  const std::pair<Vec3, std::pair<int, int>> places[] = {{{0.5, 0.5, 0}, {2, 0}},
                                                         {{0.12, 0.2, 0}, {2, 0}},
                                                         {{0, 0.5, 0.5}, {0, 0}},
                                                         {{1, 0.25, 0.85}, {0, 1}},
                                                         {{0.4, 1, 0.1}, {1, 1}}};
  for (const LightStrategy strategy : {LightStrategy::both, LightStrategy::lights, LightStrategy::bsdf}) {
    PathIntegrator integrator(lit, room, Sampler(3), 1000, strategy);
    for (const auto& [point, face] : places) {
      constexpr std::uint32_t n = 1 << 13;
      RayQuery query;
      query.ray.origin = {0.52, 0.47, 0.44};
      query.ray.direction = normalize(point - query.ray.origin);
      const std::vector<RayQuery> queries(n, query);
      const std::vector<Hit> hits(n, room.first_hit(query, *context));
      std::vector<SampleId> samples(n);
      // One sample of each of many pixels: independent, as the statistics want them.
      for (std::uint32_t i = 0; i < n; ++i) samples[i] = {static_cast<int>(i), 0, 0};
      std::vector<Rgb> light(n);
      integrator.radiance(queries, hits, samples, light, *context);
      double sum = 0, squares = 0;
      for (const Rgb& l : light) sum += l.g, squares += l.g * l.g;
      const double mean = sum / n, deviation = std::sqrt((squares / n - mean * mean) / n);
      const double expected = reference.at(point, face.first, face.second);
      EXPECT_LT(deviation, 0.03 * expected);
      EXPECT_NEAR(mean, expected, 5 * deviation + 0.002 * expected)
          << point.x << ' ' << point.y << ' ' << point.z << ", strategy " << static_cast<int>(strategy);
    }
  }
}

}  // namespace
}  // namespace tenon
