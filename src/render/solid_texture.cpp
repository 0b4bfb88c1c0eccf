#include "render/solid_texture.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace tenon {

namespace {

std::uint32_t hash(std::int64_t x, std::int64_t y, std::int64_t z) {
  // SplitMix64's finalizer (Steele, Lea, Flood 2014) over the three coordinates in turn.
  std::uint64_t h = 0;
  for (const std::int64_t c : {x, y, z}) {
    h += static_cast<std::uint64_t>(c) + 0x9e3779b97f4a7c15ULL;
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9ULL;
    h = (h ^ (h >> 27)) * 0x94d049bb133111ebULL;
    h ^= h >> 31;
  }
  return static_cast<std::uint32_t>(h >> 32);
}

// The product of an offset with one of the directions to the twelve edges of a cube.
double along_gradient(std::uint32_t which, const Vec3& v) {
  const std::uint32_t axis = which % 3;
  const double a = axis == 0 ? v.y : v.x, b = axis == 2 ? v.y : v.z;
  return ((which & 0x100U) != 0 ? -a : a) + ((which & 0x200U) != 0 ? -b : b);
}

double fade(double t) {
  return t * t * t * (t * (t * 6 - 15) + 10);
}

double mix(double t, double a, double b) {
  return a + t * (b - a);
}

// Whole numbers, where a double still has any.
std::int64_t cell(double x) {
  constexpr double farthest = 0x1p62;
  return static_cast<std::int64_t>(std::clamp(std::floor(x), -farthest, farthest));
}

}  // namespace

double gradient_noise(const Vec3& p) {
  const std::int64_t x = cell(p.x), y = cell(p.y), z = cell(p.z);
  const Vec3 f{p.x - std::floor(p.x), p.y - std::floor(p.y), p.z - std::floor(p.z)};
  const auto corner = [&](int i, int j, int k) {
    return along_gradient(hash(x + i, y + j, z + k), f - Vec3{1.0 * i, 1.0 * j, 1.0 * k});
  };
  const double u = fade(f.x), v = fade(f.y), w = fade(f.z);
  const auto plane = [&](int k) {
    return mix(v, mix(u, corner(0, 0, k), corner(1, 0, k)), mix(u, corner(0, 1, k), corner(1, 1, k)));
  };
  return mix(w, plane(0), plane(1));
}

double fractal_noise(const Vec3& point) {
  constexpr int octaves = 5;
  double sum = 0, strength = 0.5;
  Vec3 p = point;
  for (int i = 0; i < octaves; ++i) {
    sum += strength * gradient_noise(p);
    // Not quite twice as fine, and moved: zeros of the octaves shall not meet.
    p = 2.03 * p + Vec3{17.1, 5.3, 11.7};
    strength *= 0.5;
  }
  return sum;
}

double second_share(const SolidTexture& texture, const Vec3& point) {
  const Vec3 p = texture.texture_from_world.point(point) / texture.size;
  switch (texture.kind) {
    case TextureKind::none:
      return 0;
    case TextureKind::checker: {
      // Half a step off, so that faces at whole coordinates lie within cubes and not between them.
      const double sum = std::floor(p.x + 0.5) + std::floor(p.y + 0.5) + std::floor(p.z + 0.5);
      return std::fmod(std::fabs(sum), 2);
    }
    case TextureKind::marble: {
      const double wave = std::sin(2 * std::numbers::pi * (p.x + texture.turbulence * fractal_noise(p)));
      // Sharp dark veins in a light ground.
      return std::pow(1 - std::fabs(wave), 3);
    }
    case TextureKind::wood: {
      const double bent = texture.turbulence * fractal_noise({0.5 * p.x, 0.5 * p.y, 0.1 * p.z});
      const double ring = std::sqrt(p.x * p.x + p.y * p.y) + bent;
      const double year = ring - std::floor(ring);
      // A year's wood darkens slowly and ends at once; fibres run along z.
      const double fibre = 0.15 * gradient_noise({12 * p.x, 12 * p.y, 0.7 * p.z});
      return std::clamp(year * year * (1 - fade(std::max(0.0, (year - 0.9) * 10))) + fibre, 0.0, 1.0);
    }
    case TextureKind::noise:
      return std::clamp(0.5 + 0.8 * fractal_noise(p), 0.0, 1.0);
  }
  return 0;
}

}  // namespace tenon
