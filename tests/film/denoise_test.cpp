#include "tenon/film/denoise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/random.h"

namespace tenon {
namespace {

constexpr int side = 48;
constexpr std::size_t pixels = side * side;

// A wall of one light, seen with noise; the right half is another solid that is just like it.
struct Wall {
  explicit Wall(double light, double error, std::uint64_t seed) {
    Random random(seed);
    // The sum of twelve evenly spread numbers is nearly normal, with variance 1.
    const auto normal = [&] {
      double sum = -6;
      for (int k = 0; k < 12; ++k) sum += random.uniform(0, 1);
      return sum;
    };
    for (const char* name : {"R", "G", "B"}) {
      std::vector<float>& values = add(name).values;
      for (std::size_t i = 0; i < pixels; ++i) values.push_back(static_cast<float>(light + error * normal()));
    }
    for (const char* name : {"error.R", "error.G", "error.B"}) {
      std::vector<float>& values = add(name).values;
      for (std::size_t i = 0; i < pixels; ++i) values.push_back(static_cast<float>(error * normal()));
    }
    for (const char* name : {"variance.R", "variance.G", "variance.B"}) fill(name, static_cast<float>(error * error));
    for (const char* name : {"N.X", "N.Y"}) fill(name, 0);
    for (const char* name : {"N.Z", "Z", "albedo.R", "albedo.G", "albedo.B"}) fill(name, 1);
    PictureChannel& samples = add("samples");
    samples.type = ChannelType::uint32;
    samples.values.clear();
    samples.numbers.assign(pixels, 64);
    PictureChannel& ids = picture.channels.emplace_back();
    ids.name = "id.solid";
    ids.type = ChannelType::uint32;
    for (std::size_t i = 0; i < pixels; ++i) ids.numbers.push_back(i % side < side / 2 ? 1 : 2);
  }

  PictureChannel& add(const char* name) {
    picture.channels.push_back({name, ChannelType::float32, {}, {}});
    return picture.channels.back();
  }
  void fill(const char* name, float value) { add(name).values.assign(pixels, value); }
  std::vector<float>& values(const char* name) { return const_cast<PictureChannel*>(picture.find(name))->values; }
  void denoise(int threads = 1) {
    const Status status = tenon::denoise(picture, "wall.exr", {.threads = threads});
    ASSERT_TRUE(status.ok()) << status.error().message;
  }
  double error(double light) {
    double sum = 0;
    for (float v : values("G")) sum += (v - light) * (v - light);
    return std::sqrt(sum / static_cast<double>(pixels));
  }

  Picture picture{side, side, {0, 0, side, side}, {}, {}};
};

TEST(Denoise, NoiseOfAnEvenWallGoes) {
  for (const double error : {0.01, 0.1, 0.3}) {
    Wall wall(0.5, error, 9);
    const double before = wall.error(0.5);
    wall.denoise();
    // What the five levels average over is hundreds of pixels, so nearly all of it goes; what is taken back of that
    // follows from three components of 25 pixels, whose squares have a spread of sqrt(2 / 75), a sixth.
    EXPECT_LT(wall.error(0.5), before / 5) << error;
  }
}

TEST(Denoise, PixelsOfOtherIdsAreNeverMixedIn) {
  Wall one(0.5, 0.2, 3), other(0.5, 0.2, 3);
  for (const char* name : {"R", "G", "B"}) {
    for (std::size_t i = 0; i < pixels; ++i) {
      if (i % side >= side / 2) other.values(name)[i] *= 7;
    }
  }
  one.denoise();
  other.denoise();
  for (const char* name : {"R", "G", "B"}) {
    for (std::size_t i = 0; i < pixels; ++i) {
      if (i % side >= side / 2) continue;
      ASSERT_EQ(one.values(name)[i], other.values(name)[i]) << name << ' ' << i;
    }
  }
}

TEST(Denoise, EdgesOfNormalDepthAndTextureStay) {
  for (const char* what : {"N", "Z", "albedo"}) {
    Wall wall(0.5, 0.02, 4);
    for (std::size_t i = 0; i < pixels; ++i) {
      if (i / side < side / 2) continue;
      if (*what == 'N') wall.values("N.X")[i] = 1, wall.values("N.Z")[i] = 0;
      if (*what == 'Z') wall.values("Z")[i] = 3;
      for (const char* name : {"albedo.R", "albedo.G", "albedo.B"}) {
        if (*what == 'a') wall.values(name)[i] = 0.25F;
      }
      for (const char* name : {"R", "G", "B"}) wall.values(name)[i] *= 0.25F;
    }
    wall.denoise();
    double above = 0, below = 0;
    for (int x = 0; x < side; ++x) {
      above += wall.values("G")[static_cast<std::size_t>((side / 2 - 1) * side + x)] / side;
      below += wall.values("G")[static_cast<std::size_t>(side / 2 * side + x)] / side;
    }
    EXPECT_NEAR(above, 0.5, 0.01) << what;
    EXPECT_NEAR(below, 0.125, 0.01) << what;
  }
}

TEST(Denoise, WhatIsCertainStaysAsItIs) {
  Wall wall(0.5, 0.2, 6);
  for (const char* name : {"variance.R", "variance.G", "variance.B"}) {
    // One noisy pixel far to the right; everything on the left is certain.
    wall.values(name).assign(pixels, 0);
    wall.values(name).back() = 1;
  }
  const std::vector<float> before = wall.values("G");
  wall.denoise();
  for (std::size_t i = 0; i < pixels; ++i) {
    if (i % side >= side / 2) continue;
    ASSERT_FLOAT_EQ(wall.values("G")[i], before[i]) << i;
  }
}

// What is seen in glass is in no layer. However little noise there is, and even where samples are taken for worse than
// they are, by their variance alone, the filter must leave nothing worse than it was.
TEST(Denoise, DetailThatNoLayerTellsOfIsNoNoise) {
  for (const bool in_colour : {false, true}) {
    for (const double overestimate : {1.0, 4.0}) {
      for (const double error : {0.2, 0.1, 0.05, 0.02, 0.01, 0.001}) {
        Wall wall(0.5, error, 12);
        for (const char* name : {"variance.R", "variance.G", "variance.B"}) {
          for (float& v : wall.values(name)) v *= static_cast<float>(overestimate);
        }
        std::vector<double> truth(pixels);
        // Lines of all contrasts, a few pixels wide; those in colour are of one luminance.
        for (std::size_t i = 0; i < pixels; ++i) {
          const double x = static_cast<double>(i % side), y = static_cast<double>(i / side);
          truth[i] = 0.5 + 0.3 * std::sin(1.3 * x + 0.4 * y) * y / side;
          const auto shift = static_cast<float>(truth[i] - 0.5);
          for (const char* name : {"R", "B"}) wall.values(name)[i] -= in_colour ? 0.5F * shift : -shift;
          wall.values("G")[i] += shift;
        }
        const auto rms = [&] {
          double sum = 0;
          for (std::size_t i = 0; i < pixels; ++i) sum += std::pow(wall.values("G")[i] - truth[i], 2);
          return std::sqrt(sum / static_cast<double>(pixels));
        };
        const double before = rms();
        wall.denoise();
        EXPECT_LE(rms(), before) << "with an error of " << error << ", overestimated " << overestimate << " times";
      }
    }
  }
}

// A pixel that an edge runs through shows a share of both sides. Were it taken for noise of the nearer side it would
// err by up to half of what they differ by, the root of 1/12 in the mean; less than half of that must be left of it.
TEST(Denoise, EdgesStaySmooth) {
  for (const double error : {0.05, 0.03, 0.01}) {
    Wall wall(0.5, error, 5);
    // Nothing above a slanting line. What fills the larger share of a pixel gives its id and depth.
    std::vector<double> truth(pixels);
    std::vector<std::uint32_t>& ids = wall.picture.channels.back().numbers;
    for (std::size_t i = 0; i < pixels; ++i) {
      const double x = static_cast<double>(i % side), y = static_cast<double>(i / side);
      const double share = std::clamp(y - 16 - 0.3 * x, 0.0, 1.0);
      truth[i] = 0.5 * share;
      ids[i] = share >= 0.5 ? 1 : 0;
      for (const char* name : {"R", "G", "B"}) wall.values(name)[i] += static_cast<float>(truth[i] - 0.5);
      for (const char* name : {"N.Z", "albedo.R", "albedo.G", "albedo.B"}) {
        wall.values(name)[i] = static_cast<float>(share);
      }
      wall.values("Z")[i] = share >= 0.5 ? 1 : std::numeric_limits<float>::infinity();
    }
    wall.denoise();
    double sum = 0, edge_pixels = 0;
    for (std::size_t i = 0; i < pixels; ++i) {
      if (truth[i] == 0 || truth[i] == 0.5) continue;
      sum += std::pow(wall.values("G")[i] - truth[i], 2);
      ++edge_pixels;
    }
    EXPECT_LT(std::sqrt(sum / edge_pixels), 0.5 * 0.5 * std::sqrt(1.0 / 12)) << error;
  }
}

TEST(Denoise, SameBytesForAnyThreads) {
  Wall one(0.5, 0.2, 7), many(0.5, 0.2, 7);
  one.denoise(1);
  many.denoise(5);
  EXPECT_EQ(one.picture.channels, many.picture.channels);
}

TEST(Denoise, PictureWithoutNoiseStays) {
  Wall certain(0.5, 0, 1);
  certain.denoise();
  EXPECT_EQ(certain.error(0.5), 0);
}

TEST(Denoise, SaysWhatAPictureLacks) {
  Wall lacking(0.5, 0.2, 1);
  lacking.picture.channels.erase(std::find_if(lacking.picture.channels.begin(), lacking.picture.channels.end(),
                                              [](const auto& channel) { return channel.name == "variance.R"; }));
  const Status status = denoise(lacking.picture, "x.exr", {});
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message,
            "'x.exr' has no channel variance.R, which denoising goes by; render it with --layers "
            "Z,N,albedo,ids,samples,variance");
  Wall once(0.5, 0.2, 1);
  const_cast<PictureChannel*>(once.picture.find("samples"))->numbers.assign(pixels, 1);
  EXPECT_FALSE(denoise(once.picture, "x.exr", {}).ok());
}

}  // namespace
}  // namespace tenon
