#pragma once

#include "tenon/math/vec3.h"
#include "tenon/scene/texture.h"

namespace tenon {

/// How much of the second colour a solid texture has at a point of the world, 0..1.
double second_share(const SolidTexture& texture, const Vec3& point);

/// Gradient noise, in about -1..1, 0 at whole coordinates (Perlin, "Improving Noise", 2002, with gradients by a hash
/// instead of his table, so that it does not repeat).
double gradient_noise(const Vec3& point);

/// Octaves of gradient_noise(), each of half the size and strength (fractional Brownian motion); in about -1..1.
double fractal_noise(const Vec3& point);

}  // namespace tenon
