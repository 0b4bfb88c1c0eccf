#pragma once

#include <cstdint>

#include "tenon/film/film.h"

namespace tenon {

/// Samples before which nobody can tell how noisy a pixel is: what differs little so far may not have met the light
/// yet.
inline constexpr std::uint32_t least_samples_for_noise = 16;

/// How noisy a part of a film looks: over its pixels sqrt(2 / pi) times the quadratic mean of
/// (eR + eG + eB) / sqrt(R + G + B), where e is what a component may well err by, as half of the samples tell
/// (Film::error). The term is of Dammertz, Hanika, Keller, Lensch 2009, "A hierarchical automatic stopping condition
/// for Monte Carlo global illumination", equation 1; its root is near to what a display's encoding does, so that the
/// same figure looks alike in light and in shadow. They take its mean. So does this where errors are normal, since then
/// the mean is sqrt(2 / pi) times the quadratic one; but in a mean a single bright pixel of 256 hides. Here no pixel of
/// a tile errs by more than 20 times the figure, as far as is known. The film has Layer::variance.
double noise(const Film& film, const PixelWindow& window);

}  // namespace tenon
