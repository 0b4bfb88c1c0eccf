#include "tenon/film/film.h"

#include <gtest/gtest.h>

#include <cmath>

#include "film/random_film.h"
#include "tenon/film/film_picture.h"

namespace tenon {
namespace {

TEST(Film, MeansAndStandardErrorOfItsSamples) {
  Film film(4, 4, {1, 2, 3, 4}, Layers{Layer::variance});
  const double values[] = {0.25, 1, 0.5, 4, 0.125};
  for (double v : values) {
    FilmSample sample;
    sample.light = {v, 2 * v, 1};
    sample.alpha = v < 1 ? 0 : 1;
    film.add(2, 3, sample);
  }
  double mean = 0, squares = 0;
  for (double v : values) mean += v / 5;
  for (double v : values) squares += (v - mean) * (v - mean);
  EXPECT_EQ(film.samples(2, 3), 5U);
  EXPECT_DOUBLE_EQ(film.light(2, 3).r, mean);
  EXPECT_DOUBLE_EQ(film.light(2, 3).g, 2 * mean);
  EXPECT_DOUBLE_EQ(film.alpha(2, 3), 0.4);
  EXPECT_NEAR(film.variance(2, 3).r, squares / 4 / 5, 1e-12);
  EXPECT_NEAR(film.variance(2, 3).g, 4 * squares / 4 / 5, 1e-12);
  EXPECT_EQ(film.variance(2, 3).b, 0);
  EXPECT_EQ(film.samples(1, 2), 0U);
  EXPECT_EQ(film.light(1, 2), Rgb{});
  EXPECT_EQ(film.variance(1, 2), Rgb{});
}

TEST(Film, HalvesAreBlocksByTurns) {
  const auto halves = [](std::uint32_t samples) {
    std::string text;
    for (std::uint32_t i = 0; i < std::min(samples, 70U); ++i) text += is_in_second_half(i, samples) ? 'b' : 'a';
    return text;
  };
  EXPECT_EQ(halves(1), "a");
  EXPECT_EQ(halves(2), "ab");
  EXPECT_EQ(halves(3), "aba");
  EXPECT_EQ(halves(8), "aaaabbbb");
  EXPECT_EQ(halves(12), "aaaabbbbaaaa");
  const std::string a(16, 'a'), b(16, 'b');
  EXPECT_EQ(halves(64), a + b + a + b);
  EXPECT_EQ(halves(1000), a + b + a + b + "aaaaaa");
}

// Over many pixels of independent samples the square of what the halves tell is the squared error, however unequal the
// halves are.
TEST(Film, HalvesTellTheError) {
  const std::uint64_t seed = 3;
  SCOPED_TRACE(seed);
  Random random(seed);
  constexpr int pixels = 20000;
  for (const std::uint32_t samples : {2U, 3U, 8U, 12U}) {
    Film film(pixels, 1, {0, 0, pixels, 1}, Layers{Layer::variance});
    double told = 0, true_error = 0;
    for (int x = 0; x < pixels; ++x) {
      for (std::uint32_t i = 0; i < samples; ++i) {
        FilmSample sample;
        sample.is_in_second_half = is_in_second_half(i, samples);
        sample.light = {1, random.uniform(0, 1), 0};
        film.add(x, 0, sample);
      }
      EXPECT_EQ(film.error(x, 0).r, 0);
      told += std::pow(film.error(x, 0).g, 2);
      true_error += std::pow(film.light(x, 0).g - 0.5, 2);
    }
    // A squared difference of means has a relative variance of 2 at most, so has a squared error.
    EXPECT_NEAR(told / true_error, 1, 5 * std::sqrt(4.0 / pixels)) << samples;
    EXPECT_NEAR(true_error / pixels, 1.0 / 12 / samples, 5 * std::sqrt(2.0 / pixels) / 12 / samples) << samples;
  }
}

TEST(Film, WithoutASecondHalfTheSamplesTellTheError) {
  Film film(1, 1, {0, 0, 1, 1}, Layers{Layer::variance});
  EXPECT_EQ(film.error(0, 0), Rgb{});
  for (const double v : {0.25, 1.0, 0.5}) {
    FilmSample sample;
    sample.light = {v, v, v};
    film.add(0, 0, sample);
  }
  EXPECT_DOUBLE_EQ(film.error(0, 0).r, std::sqrt(film.variance(0, 0).r));
}

TEST(Film, FirstSampleIsTheOneOfTheLowestIndexWheneverItComes) {
  for (const auto& order : {std::array{3U, 1U, 7U}, std::array{1U, 3U, 7U}, std::array{7U, 3U, 1U}}) {
    Film film(1, 1, {0, 0, 1, 1}, all_planes());
    for (std::uint32_t index : order) {
      FilmSample sample;
      sample.index = index;
      sample.depth = index;
      sample.ids.primitive = index;
      film.add(0, 0, sample);
    }
    EXPECT_EQ(film.planes().depth[0], 1.0F);
    EXPECT_EQ(film.planes().ids[0][0], 1U);
  }
}

TEST(FilmPicture, ChannelsThatCompositorsExpect) {
  Film film(6, 5, {1, 1, 5, 4}, all_planes());
  take(film, 0, 3);
  Layers layers = all_planes();
  layers.add(Layer::samples);
  const Picture picture = film_picture(film, layers, 16);
  EXPECT_EQ(picture.width, 6);
  EXPECT_EQ(picture.window, (PixelWindow{1, 1, 5, 4}));
  for (const char* name : {"R", "G", "B", "A", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B"}) {
    ASSERT_NE(picture.find(name), nullptr) << name;
    EXPECT_EQ(picture.find(name)->type, ChannelType::half) << name;
    EXPECT_EQ(picture.find(name)->values.size(), 12U) << name;
  }
  for (const char* name : {"Z", "P.X", "P.Y", "P.Z", "crossings", "path_length", "variance.R", "variance.G",
                           "variance.B", "error.R", "error.G", "error.B"}) {
    ASSERT_NE(picture.find(name), nullptr) << name;
    EXPECT_EQ(picture.find(name)->type, ChannelType::float32) << name;
  }
  for (const char* name : {"id.primitive", "id.material", "id.solid", "samples"}) {
    ASSERT_NE(picture.find(name), nullptr) << name;
    EXPECT_EQ(picture.find(name)->type, ChannelType::uint32) << name;
  }
  EXPECT_EQ(picture.channels.size(), 26U);
  EXPECT_EQ(picture.find("id.primitive")->numbers[5], random_sample(2, 2, 0).ids.primitive);
  EXPECT_EQ(film_picture(film, {}, 32).channels.size(), 4U);
}

TEST(FilmPicture, DisplayedColourIsNotWeightedWithAlpha) {
  Film film(2, 1, {0, 0, 2, 1}, {});
  FilmSample half, nothing;
  half.light = {0.25, 0.5, 1};
  nothing.alpha = 0;
  film.add(0, 0, half);
  film.add(0, 0, nothing);
  const Picture picture = film_picture(film, {}, 32);
  EXPECT_EQ(picture.find("R")->values[0], 0.125F);
  const DisplayPixels shown = display_pixels(picture, {}, true);
  EXPECT_EQ(shown.rgb, (std::vector<float>{0.25F, 0.5F, 1, 0, 0, 0}));
  EXPECT_EQ(shown.alpha, (std::vector<float>{0.5F, 0}));
  // Nobody asked for it, but it is not all there.
  EXPECT_EQ(display_pixels(picture, {}, false).alpha, shown.alpha);
  Film whole(1, 1, {0, 0, 1, 1}, {});
  whole.add(0, 0, FilmSample{});
  EXPECT_TRUE(display_pixels(film_picture(whole, {}, 32), {}, false).alpha.empty());
  EXPECT_EQ(display_pixels(film_picture(whole, {}, 32), {}, true).alpha, std::vector<float>{1});
}

TEST(Layers, NamesAreReadAndWritten) {
  EXPECT_EQ(layers_text(*parse_layers("ids,Z")), "Z,ids");
  EXPECT_TRUE(parse_layers("none")->empty());
  EXPECT_FALSE(parse_layers("all")->has(Layer::sums));
  EXPECT_TRUE(parse_layers("all")->has(Layer::variance));
  for (const char* wrong : {"", "z", "Z,", "Z ,N", "sum"}) {
    const auto layers = parse_layers(wrong);
    ASSERT_FALSE(layers.ok()) << wrong;
    EXPECT_EQ(layers.error().kind, ErrorKind::usage);
    EXPECT_NE(layers.error().message.find("path_length"), std::string::npos);
  }
}

}  // namespace
}  // namespace tenon
