#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "render/path.h"
#include "render/whitted.h"
#include "tenon/lang/load.h"

namespace tenon {
namespace {

Scene scene_of(const std::string& text) {
  Diagnostics diagnostics;
  Result<Model> model = load_model_text(text, "test.scad", {}, diagnostics);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : model.error().message);
  Result<Scene> scene = compile_scene(std::move(*model), diagnostics);
  EXPECT_TRUE(scene.ok());
  EXPECT_TRUE(diagnostics.warnings().empty()) << diagnostics.warnings().front();
  return std::move(*scene);
}

// Rays from one place in all directions, evenly.
std::vector<RayQuery> rays_from(const Vec3& origin, int count) {
  std::vector<RayQuery> queries(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1.0) / count, longitude = 2.399963229728653 * i, r = std::sqrt(1 - z * z);
    queries[static_cast<std::size_t>(i)].ray = {origin, {r * std::cos(longitude), r * std::sin(longitude), z}};
  }
  return queries;
}

std::vector<Rgb> light_along(Integrator& integrator, const Accelerator& accelerator,
                             std::span<const RayQuery> queries) {
  const auto context = accelerator.make_context();
  std::vector<Hit> hits(queries.size());
  accelerator.first_hits(queries, hits, *context);
  std::vector<SampleId> samples(queries.size());
  for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = {static_cast<int>(i), 0, 0};
  std::vector<Rgb> light(queries.size());
  integrator.radiance(queries, hits, samples, light, *context);
  EXPECT_EQ(context->statistics.seam_faults, 0U);
  return light;
}

// Nested dielectrics by hand: balls around the origin, each boundary told the media on its two sides.
class Nest final : public Accelerator {
 public:
  struct Ball {
    double radius;
    MediumId outside, inside;
    MaterialId material;
  };
  explicit Nest(std::vector<Ball> balls) : balls_(std::move(balls)) {}

  std::unique_ptr<TraceContext> make_context() const override { return std::make_unique<Context>(); }
  void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext&) const override {
    for (std::size_t i = 0; i < queries.size(); ++i) {
      hits[i] = Hit{};
      for (std::size_t ball = 0; ball < balls_.size(); ++ball) meet(queries[i], ball, hits[i]);
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

  void meet(const RayQuery& query, std::size_t index, Hit& nearest) const {
    const Ball& ball = balls_[index];
    const Vec3 &o = query.ray.origin, &d = query.ray.direction;
    const double b = dot(o, d), c = dot(o, o) - ball.radius * ball.radius;
    const bool starts_here = query.from != nullptr && query.from->surface.leaf == LeafId{index};
    if (b * b - c <= 0) return;
    const double root = std::sqrt(b * b - c);
    for (const double t : {starts_here ? -2 * b : -b - root, starts_here ? -1.0 : -b + root}) {
      if (!(t > 0) || !(t < nearest.t) || !(t < query.t_max)) continue;
      nearest.t = t;
      nearest.point = query.ray.at(t);
      nearest.normal = normalize(nearest.point);
      nearest.surface = {LeafId{index}, 0};
      nearest.material = ball.material;
      const bool inward = dot(nearest.normal, d) < 0;
      nearest.before = inward ? ball.outside : ball.inside;
      nearest.after = inward ? ball.inside : ball.outside;
      nearest.entering = nearest.after != medium_outside;
    }
  }

  std::vector<Ball> balls_;
};

constexpr const char* media_modules = R"(
  module glass() material(model = "dielectric", ior = 1.5, attenuation_color = [0.5, 0.9, 0.7], attenuation_distance = 1,
                          priority = 1) children();
  module water() material(model = "dielectric", ior = 1.33, attenuation_color = [0.4, 0.6, 0.9], attenuation_distance = 2,
                          priority = 2) children();
  module ice() material(model = "dielectric", ior = 1.31, priority = 3) children();
  light(type = "environment");
)";

// Glass full of water with ice in it, told three ways: cut to size so that faces coincide, by priorities, and by the
// order in the file. Each must look like the nest by hand, from outside and from within each medium, by every
// structure.
TEST(Media, NestedSolidsAreNestedDielectricsByHand) {
  const std::string ways[] = {
      "glass() difference() { sphere(2); sphere(1.8); } water() difference() { sphere(1.8); sphere(0.8); } ice() "
      "sphere(0.8);",
      "glass() sphere(2); water() sphere(1.8); ice() sphere(0.8);",
      "ice() sphere(0.8); water() difference() { sphere(1.8); sphere(0.6); } glass() difference() { sphere(2); "
      "sphere(1.8); }"};
  auto map = std::make_shared<LightMap>(LightMap{8, 4, {}});
  for (int i = 0; i < 96; ++i) map->rgb.push_back(0.2F + 0.13F * static_cast<float>(i * i % 7));
  for (const std::string& way : ways) {
    Scene scene = scene_of(media_modules + way);
    for (Light& light : scene.lights) light.map = map;
    const LitScene lit(scene);
    MediumId glass = 0, water = 0, ice = 0;
    for (MediumId m = 2; m < scene.media.size(); ++m) {
      (scene.media[m].ior == 1.5 ? glass : scene.media[m].ior == 1.33 ? water : ice) = m;
    }
    const MaterialId any{0};
    const Nest nest({{2, medium_outside, glass, any}, {1.8, glass, water, any}, {0.8, water, ice, any}});
    for (const std::string& spec : accelerator_specs()) {
      const auto accelerator = build_accelerator(spec, *scene.tree);
      ASSERT_TRUE(accelerator.ok());
      for (const Vec3& eye : {Vec3{0.3, -5, 1}, Vec3{0, -1.9, 0.1}, Vec3{0.1, -1.2, 0.3}, Vec3{0.1, 0.2, -0.3}}) {
        const std::vector<RayQuery> queries = rays_from(eye, 60);
        WhittedIntegrator whitted(lit, **accelerator, {9, 0}), whitted_by_hand(lit, nest, {9, 0});
        PathIntegrator path(lit, **accelerator, Sampler(1), 30), path_by_hand(lit, nest, Sampler(1), 30);
        const auto expect_same = [&](Integrator& a, Integrator& b) {
          const std::vector<Rgb> found = light_along(a, **accelerator, queries),
                                 expected = light_along(b, nest, queries);
          for (std::size_t i = 0; i < queries.size(); ++i) {
            ASSERT_NEAR(found[i].r, expected[i].r, 1e-8)
                << spec << ", ray " << i << " from y = " << eye.y << ", " << way;
            ASSERT_NEAR(found[i].b, expected[i].b, 1e-8)
                << spec << ", ray " << i << " from y = " << eye.y << ", " << way;
          }
        };
        expect_same(whitted, whitted_by_hand);
        expect_same(path, path_by_hand);
      }
    }
  }
}

// In light of radiance 1 from everywhere, no path loses anything at clear boundaries or white solids: a path that is
// lost at a seam shows as less. Walls of the tumbler touch the water, an ice cube floats in it, a white ball stands
// embedded in the foot. Within a medium light is brighter by the square of its index.
TEST(Media, NoPathIsLostInAGlassOfWater) {
  const Scene scene = scene_of(R"(
    module glass() material(model = "dielectric", ior = 1.5, priority = 3) children();
    module water() material(model = "dielectric", ior = 1.33, priority = 1) children();
    module ice() material(model = "dielectric", ior = 1.31, priority = 2) children();
    light(type = "environment");
    rotate([12, 31, 17]) {
      glass() difference() {
        cylinder(h = 5, r1 = 2, r2 = 2.4);
        translate([0, 0, 1.2]) cylinder(h = 5, r1 = 1.8, r2 = 2.2);
      }
      water() intersection() {
        translate([0, 0, 1.2]) cylinder(h = 5, r1 = 1.8, r2 = 2.2);
        translate([-4, -4, 0]) cube([8, 8, 4]);
      }
      translate([0.2, 0.1, 3.4]) rotate([20, 30, 10]) ice() cube(1.5, center = true);
      translate([0, 0, 0.6]) material(model = "lambert", color = "white", priority = 9) sphere(0.5);
    })");
  const LitScene lit(scene);
  for (const std::string spec : {"cells", "multi-kd", "okd", "goldsmith-bvh", "space-tracing"}) {
    const auto accelerator = build_accelerator(spec, *scene.tree);
    ASSERT_TRUE(accelerator.ok());
    PathIntegrator path(lit, **accelerator, Sampler(1), 3000);
    const Affine3 turn = Affine3::rotate({12, 31, 17});
    const std::pair<Vec3, double> eyes[] = {{{3, -6, 5}, 1},
                                            {turn.point({-1, 0.2, 2}), 1.33},
                                            {turn.point({0.2, 0.1, 3.4}), 1.31},
                                            {turn.point({1.2, 0, 0.5}), 1.5}};
    for (const auto& [eye, ior] : eyes) {
      const std::vector<RayQuery> queries = rays_from(eye, 400);
      const std::vector<Rgb> light = light_along(path, **accelerator, queries);
      for (std::size_t i = 0; i < light.size(); ++i) {
        ASSERT_NEAR(light[i].g, ior * ior, 1e-9) << spec << ", ray " << i << " within index " << ior;
      }
    }
  }
}

TEST(Media, AttenuationIsBeersLaw) {
  const double kept = linear_from_srgb({0.5, 0.5, 0.5, 1}).r;
  const Scene scene = scene_of(R"(
    material(model = "dielectric", ior = 1, color = "white", attenuation_color = [0.5, 0.5, 0.5], attenuation_distance = 2)
      translate([-9, -9, 1]) cube([18, 18, 3]);
    material(model = "lambert", color = "white") translate([-9, -9, -1]) cube([18, 18, 1]);
    light(position = [0, 0, 7]);
    ambient(0);
    background([1, 1, 1]);)");
  const LitScene lit(scene);
  const auto accelerator = build_accelerator("cells", *scene.tree);
  std::vector<RayQuery> queries(2);
  queries[0].ray = {{0, 0, 9}, {0, 0, -1}};
  queries[1].ray = {{0, 0, 0.5}, normalize({3, 0, -0.5})};
  // The floor alone reflects, and nothing but black lies around it: no path of more surfaces brings light.
  PathIntegrator path(lit, **accelerator, Sampler(1), 3);
  WhittedIntegrator whitted(lit, **accelerator, {4, 0});
  for (Integrator* integrator : std::initializer_list<Integrator*>{&path, &whitted}) {
    const std::vector<Rgb> light = light_along(*integrator, **accelerator, queries);
    // 3 of length on the way from the light, and 3 again on the way to the eye.
    EXPECT_NEAR(light[0].g, std::pow(kept, 1.5) * std::pow(kept, 1.5), 1e-12);
    // At (3, 0, 0), 7 below the light.
    const double slant = std::sqrt(9.0 + 49.0) / 7;
    EXPECT_NEAR(light[1].g, std::pow(kept, 1.5 * slant) / slant, 1e-12);
  }
  // Glass of an index bends light, so that a point light is not found through it; that is what the picture shows.
  Scene bent = scene;
  for (Medium& m : bent.media) {
    if (m.attenuation.r > 0) m.ior = 1.5;
  }
  const LitScene lit_bent(bent);
  PathIntegrator path_bent(lit_bent, **accelerator, Sampler(1), 2);
  EXPECT_EQ(light_along(path_bent, **accelerator, queries)[1], Rgb{});
}

}  // namespace
}  // namespace tenon
