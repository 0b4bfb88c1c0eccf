#include "render/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/random.h"

namespace tenon {
namespace {

constexpr int side = 16;
constexpr PixelWindow tile{0, 0, side, side};

// Grey pixels of light 1/3 in each component, so that the root of their sum is 1, and of known errors: two samples, one
// in each half, differ by twice the error.
Film film_of(const std::vector<double>& errors) {
  Film film(side, side, tile, Layers{Layer::variance});
  for (int i = 0; i < side * side; ++i) {
    for (const std::uint32_t index : {0U, 1U}) {
      FilmSample sample;
      sample.index = index;
      sample.is_in_second_half = index == 1;
      const double light = 1.0 / 3 + (index == 1 ? 1 : -1) * errors[static_cast<std::size_t>(i)] / 3;
      sample.light = {light, light, light};
      film.add(i % side, i / side, sample);
    }
  }
  return film;
}

TEST(Noise, OfNormalErrorsIsTheirMean) {
  constexpr std::uint64_t seed = 11;
  SCOPED_TRACE(seed);
  Random random(seed);
  std::vector<double> errors;
  double mean = 0;
  for (int i = 0; i < side * side; ++i) {
    // The sum of twelve evenly spread numbers is nearly normal, with variance 1.
    double normal = -6;
    for (int k = 0; k < 12; ++k) normal += random.uniform(0, 1);
    errors.push_back(0.02 * normal);
    mean += std::fabs(errors.back()) / (side * side);
  }
  // The ratio of a mean to a quadratic one spreads by 3 % at 256 pixels.
  EXPECT_NEAR(noise(film_of(errors), tile) / mean, 1, 0.1);
}

TEST(Noise, SingleBrightPixelDoesNotHide) {
  std::vector<double> errors(side * side, 0.0);
  errors[77] = 0.42;
  EXPECT_GT(noise(film_of(errors), tile), 0.02);
  EXPECT_LT(errors[77] / (side * side), 0.002) << "its mean is far below";
  errors[77] = 0.38;
  EXPECT_LT(noise(film_of(errors), tile), 0.02);
}

}  // namespace
}  // namespace tenon
