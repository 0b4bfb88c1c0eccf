#pragma once

#include <cstdint>

#include "tenon/film/film.h"

namespace tenon {

/// Samples before which nobody can tell how noisy a pixel is: what differs little so far may not have met the light
/// yet.
inline constexpr std::uint32_t least_samples_for_noise = 16;

/// How noisy a part of a film looks: the mean over its pixels of (eR + eG + eB) / sqrt(R + G + B), where e is what a
/// component may well err by, as half of the samples tell (Film::error; Dammertz, Hanika, Keller, Lensch 2009, "A
/// hierarchical automatic stopping condition for Monte Carlo global illumination", equation 1). The root is near to
/// what a display's encoding does, so that the same figure looks alike in light and in shadow. The film has
/// Layer::variance.
double noise(const Film& film, const PixelWindow& window);

}  // namespace tenon
