#include "render/surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "render/frame_block.h"
#include "support/instruction_sets.h"

namespace tenon {
namespace {

constexpr double pi = std::numbers::pi;

struct Case {
  std::string name;
  Material material;
  double ior_before = 1, ior_behind = 1;
};

Case make_case(const std::string& name, MaterialModel model, double roughness, double ior = 1.5) {
  Case c{name, {}, 1, 1};
  c.material.model = model;
  c.material.roughness = roughness;
  c.material.ior = ior;
  if (c.material.is_transparent()) c.ior_behind = ior;
  return c;
}

// White, so that whatever conserves energy returns all light.
std::vector<Case> cases() {
  std::vector<Case> all;
  all.push_back(make_case("lambert", MaterialModel::lambert, 0));
  all.push_back(make_case("phong", MaterialModel::phong, 0));
  for (const double roughness : {0.4, 0.6, 1.0}) {
    const std::string r = std::to_string(roughness).substr(0, 3);
    all.push_back(make_case("conductor " + r, MaterialModel::conductor, roughness));
    all.push_back(make_case("dielectric " + r, MaterialModel::dielectric, roughness));
    all.push_back(make_case("dielectric from inside " + r, MaterialModel::dielectric, roughness));
    std::swap(all.back().ior_before, all.back().ior_behind);
    all.push_back(make_case("glass in water " + r, MaterialModel::dielectric, roughness));
    all.back().ior_before = 1.33;
    all.push_back(make_case("principled " + r, MaterialModel::principled, roughness));
    all.push_back(make_case("principled of all layers " + r, MaterialModel::principled, roughness));
    all.back().material.metallic = 0.3;
    all.back().material.transmission = 0.4;
    all.back().material.coat = 0.7;
    all.back().material.coat_roughness = 0.3;
    all.back().ior_behind = 1.5;
  }
  return all;
}

Vec3 direction(double degrees) {
  return {std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180)};
}

// The BSDF of one point.
class PointBsdf {
 public:
  PointBsdf(const Case& c, const Vec3& wo, AlbedoTables& tables) {
    wo_.set(0, wo);
    RgbBlock white;
    white.set(0, {1, 1, 1});
    Surface(c.material, tables).scatter(wo_, white, {c.ior_before, c.ior_behind, false}, 1, bsdf_);
  }

  struct Value {
    Rgb light;
    double density;
  };
  Value evaluate(const Vec3& wi) {
    wi_.set(0, wi);
    bsdf_.evaluate(wi_, values_);
    return {values_.light[0], values_.density[0]};
  }

  struct Drawn {
    Vec3 direction;
    Rgb weight;
    double density;
  };
  // A weight of 0: the light is lost.
  Drawn sample(double choice, const Sample2& place) {
    choice_[0] = choice;
    place_.set(0, place);
    bsdf_.sample(choice_, place_, samples_);
    return {samples_.direction[0], samples_.weight[0], samples_.density[0]};
  }

 private:
  Vec3Block wo_, wi_;
  Bsdf bsdf_;
  BsdfValues values_;
  NumberBlock choice_{};
  Sample2Block place_;
  BsdfSamples samples_;
};

// Light of radiance 1 from everywhere is radiance n^2 within a medium of index n; over the n^2 of the viewer's side all
// of it must come back. The mean over 2^18 points of a sequence that fills the square evenly.
TEST(Surface, ReturnsAllLightOfAFurnace) {
  AlbedoTables tables;
  for (const Case& c : cases()) {
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
      PointBsdf bsdf(c, direction(degrees), tables);
      constexpr int n = 1 << 16;
      const Sampler sampler(11);
      double sum = 0, squares = 0;
      for (int i = 0; i < n; ++i) {
        const auto sample = bsdf.sample(sampler({i, 0, 0}, 0).u, sampler({i, 0, 0}, 1));
        const double n2 = sample.direction.z < 0 ? std::pow(c.ior_behind / c.ior_before, 2) : 1;
        sum += sample.weight.g * n2;
        squares += sample.weight.g * n2 * sample.weight.g * n2;
      }
      const double deviation = std::sqrt(std::max(0.0, squares / n - sum / n * (sum / n)) / n);
      EXPECT_NEAR(sum / n, 1, 6 * deviation + 2e-4) << c.name << " at " << degrees << " degrees";
    }
  }
}

// The same by the values of evaluate() alone, over a grid of directions in steps of angles: to four digits, but where
// upright microfacets or total reflection end it in an edge, or light is hardly bent, which the grid finds to its step.
TEST(Surface, ReturnsAllLightByItsValuesToFourDigits) {
  AlbedoTables tables;
  for (const Case& c : cases()) {
    for (const double degrees : {10.0, 55.0}) {
      PointBsdf bsdf(c, direction(degrees), tables);
      constexpr int n = 500;
      double light = 0, density = 0;
      for (int i = 0; i < 2 * n; ++i) {
        const double theta = pi / 2 * (i + 0.5) / n, z = std::cos(theta), r = std::sin(theta);
        for (int j = 0; j < n; ++j) {
          const double phi = pi * (j + 0.5) / n;
          const PointBsdf::Value value = bsdf.evaluate({r * std::cos(phi), r * std::sin(phi), z});
          light += r * value.light.g * (z < 0 ? std::pow(c.ior_behind / c.ior_before, 2) : 1);
          density += r * value.density;
        }
      }
      const double cell = pi * pi / (static_cast<double>(n) * n);
      const bool is_sharp = c.ior_before > 1 || c.material.roughness == 1;
      const double near = is_sharp ? 3e-3 : 1e-4;
      EXPECT_NEAR(light * cell, 1, near) << c.name << " at " << degrees << " degrees";
      EXPECT_LE(density * cell, 1 + 1e-4) << c.name << " at " << degrees << " degrees";
    }
  }
}

// Pearson's test of drawn directions against their density, in boxes of equal angles; what is lost has a box of its
// own. The statistic is about normal by Wilson and Hilferty; beyond 5.5 standard deviations there is a false alarm
// in 5e7 cases.
TEST(Surface, DirectionsAreDrawnWithTheirDensity) {
  AlbedoTables tables;
  constexpr int rows = 24, columns = 12, fine = 32;
  constexpr int draws = 20000;
  std::uint32_t pixel = 0;
  for (const Case& c : cases()) {
    if (c.ior_before == 1.33) continue;  // light that is hardly bent wants a grid too fine to sum over
    for (const double degrees : {5.0, 50.0, 80.0}) {
      PointBsdf bsdf(c, direction(degrees), tables);
      std::vector<double> expected(rows * columns + 1), drawn(rows * columns + 1);
      double rest = draws;
      for (int i = 0; i < rows * fine; ++i) {
        const double theta = pi * (i + 0.5) / (rows * fine), z = std::cos(theta), r = std::sin(theta);
        for (int j = 0; j < columns * fine; ++j) {
          const double phi = 2 * pi * (j + 0.5) / (columns * fine);
          const double share = bsdf.evaluate({r * std::cos(phi), r * std::sin(phi), z}).density * r * 2 * pi * pi /
                               (rows * fine * columns * fine);
          expected[static_cast<std::size_t>(i / fine * columns + j / fine)] += draws * share;
          rest -= draws * share;
        }
      }
      expected.back() = rest;
      ++pixel;
      for (std::uint32_t i = 0; i < draws; ++i) {
        // One sample of each of many pixels: independent draws, as the test wants them.
        const SampleId id{static_cast<int>(i), static_cast<int>(pixel), 0};
        const Sampler sampler(5);
        const auto sample = bsdf.sample(sampler(id, 0).u, sampler(id, 1));
        if (!(sample.density > 0)) {
          ++drawn.back();
          continue;
        }
        const Vec3& d = sample.direction;
        double phi = std::atan2(d.y, d.x);
        if (phi < 0) phi += 2 * pi;
        const int row = std::min(rows - 1, static_cast<int>(std::acos(d.z) / pi * rows));
        const int column = std::min(columns - 1, static_cast<int>(phi / (2 * pi) * columns));
        ++drawn[static_cast<std::size_t>(row * columns + column)];
      }
      // Boxes in which little is expected are pooled.
      double statistic = 0, pooled_expected = 0, pooled_drawn = 0;
      int boxes = 0;
      const auto count = [&](double e, double d) {
        statistic += (d - e) * (d - e) / e;
        ++boxes;
      };
      for (std::size_t i = 0; i < expected.size(); ++i) {
        if (expected[i] >= 10) {
          count(expected[i], drawn[i]);
        } else {
          pooled_expected += expected[i];
          pooled_drawn += drawn[i];
        }
      }
      if (pooled_expected >= 5) count(pooled_expected, pooled_drawn);
      ASSERT_GT(boxes, 3) << c.name;
      const double freedom = boxes - 1, k = 2 / (9 * freedom);
      const double deviations = (std::cbrt(statistic / freedom) - (1 - k)) / std::sqrt(k);
      EXPECT_LT(deviations, 5.5) << c.name << " at " << degrees << " degrees, statistic " << statistic << " of "
                                 << boxes << " boxes";
    }
  }
}

Vec3 direction(const Sample2& place) {
  const double z = 2 * place.u - 1, r = std::sqrt(1 - z * z);
  return {r * std::cos(2 * pi * place.v), r * std::sin(2 * pi * place.v), z};
}

// Numbers of all points of a block, seen from everywhere, lit from everywhere.
std::vector<double> scattered(const Case& c, AlbedoTables& tables) {
  const Sampler sampler(7);
  Vec3Block normal, seen, wo, light, wi, world;
  RgbBlock color;
  NumberBlock choice;
  Sample2Block place;
  for (std::size_t i = 0; i < block_size; ++i) {
    const SampleId id{static_cast<int>(i), 0, 0};
    normal.set(i, direction(sampler(id, 0)));
    seen.set(i, direction(sampler(id, 1)));
    light.set(i, direction(sampler(id, 2)));
    color.set(i, {sampler(id, 3).u, sampler(id, 3).v, sampler(id, 4).u});
    choice[i] = sampler(id, 4).v;
    place.set(i, sampler(id, 5));
  }
  FrameBlock frames;
  frames.find(normal, seen, block_size, wo);
  frames.to_local(light, wi);
  Bsdf bsdf;
  Surface(c.material, tables).scatter(wo, color, {c.ior_before, c.ior_behind, false}, block_size, bsdf);
  BsdfValues values;
  bsdf.evaluate(wi, values);
  BsdfSamples samples;
  bsdf.sample(choice, place, samples);
  frames.to_world(samples.direction, world);
  std::vector<double> numbers;
  for (const NumberBlock* block : {&values.light.r, &values.light.g, &values.light.b, &values.density, &world.x,
                                   &world.y, &world.z, &samples.weight.r, &samples.weight.g, &samples.density}) {
    numbers.insert(numbers.end(), block->begin(), block->end());
  }
  return numbers;
}

TEST(Surface, EveryInstructionSetScattersToTheSameBits) {
  AlbedoTables tables;
  for (const Case& c : cases()) {
    const std::vector<double> expected = scattered(c, tables);
    EXPECT_TRUE(std::ranges::any_of(expected, [](double number) { return number > 0; }));
    for_each_instruction_set([&] { EXPECT_EQ(scattered(c, tables), expected) << c.name; });
  }
}

// However many points a block has, each is scattered as by itself.
TEST(Surface, PointsOfABlockKnowNothingOfEachOther) {
  AlbedoTables tables;
  const Sampler sampler(9);
  for (const Case& c : cases()) {
    for (const std::size_t count : {1U, 7U, 8U, 13U, 64U}) {
      Vec3Block wo, wi;
      RgbBlock white;
      for (std::size_t i = 0; i < count; ++i) {
        wo.set(i, direction(5.0 + static_cast<double>(i)));
        wi.set(i, direction(sampler({static_cast<int>(i), 0, 0}, 0)));
        white.set(i, {1, 1, 1});
      }
      Bsdf bsdf;
      Surface(c.material, tables).scatter(wo, white, {c.ior_before, c.ior_behind, false}, count, bsdf);
      BsdfValues values;
      bsdf.evaluate(wi, values);
      for (std::size_t i = 0; i < count; ++i) {
        const PointBsdf::Value alone = PointBsdf(c, wo[i], tables).evaluate(wi[i]);
        EXPECT_EQ(values.light.g[i], alone.light.g) << c.name << ", " << i << " of " << count;
        EXPECT_EQ(values.density[i], alone.density) << c.name << ", " << i << " of " << count;
      }
    }
  }
}

}  // namespace
}  // namespace tenon
