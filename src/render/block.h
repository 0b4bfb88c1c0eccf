#pragma once

#include <array>
#include <cstddef>

#include "render/sampler.h"
#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// Points that are worked on together, an array for each of their numbers: compilers make vectors of loops over them.
inline constexpr std::size_t block_size = 64;

/// How far loops go that work on the first `count` points: whole vectors, whatever the instruction set. What lies
/// beyond the points are numbers of no meaning.
constexpr std::size_t whole_vectors(std::size_t count) {
  constexpr std::size_t most_lanes = 8;
  return (count + most_lanes - 1) / most_lanes * most_lanes;
}

using NumberBlock = std::array<double, block_size>;

struct Vec3Block {
  NumberBlock x{}, y{}, z{};

  Vec3 operator[](std::size_t i) const { return {x[i], y[i], z[i]}; }
  void set(std::size_t i, const Vec3& v) {
    x[i] = v.x;
    y[i] = v.y;
    z[i] = v.z;
  }
};

struct RgbBlock {
  NumberBlock r{}, g{}, b{};

  Rgb operator[](std::size_t i) const { return {r[i], g[i], b[i]}; }
  void set(std::size_t i, const Rgb& c) {
    r[i] = c.r;
    g[i] = c.g;
    b[i] = c.b;
  }
};

struct Sample2Block {
  NumberBlock u{}, v{};

  Sample2 operator[](std::size_t i) const { return {u[i], v[i]}; }
  void set(std::size_t i, const Sample2& sample) {
    u[i] = sample.u;
    v[i] = sample.v;
  }
};

}  // namespace tenon
