#pragma once

#include "support/random.h"
#include "tenon/film/film.h"

namespace tenon {

inline Layers all_planes() {
  return Layers{Layer::depth, Layer::normal,    Layer::point,       Layer::albedo,
                Layer::ids,   Layer::crossings, Layer::path_length, Layer::variance};
}

/// Some sample of some pixel: the same each time it is asked for.
inline FilmSample random_sample(int x, int y, std::uint32_t index) {
  Random random((static_cast<std::uint64_t>(y) << 40U) + (static_cast<std::uint64_t>(x) << 20U) + index);
  FilmSample s;
  s.index = index;
  s.is_in_second_half = is_in_second_half(index, 8);
  s.light = {random.magnitude(-9, 6), random.magnitude(-3, 0), random.uniform(0, 1)};
  s.alpha = random.chance(0.8) ? 1 : 0;
  if (random.chance(0.1)) return s;
  s.depth = random.magnitude(-3, 3);
  s.normal = random.direction();
  s.point = 100 * random.in_cube();
  s.albedo = {random.uniform(0, 1), random.uniform(0, 1), random.uniform(0, 1)};
  s.ids = {static_cast<std::uint32_t>(random.bits()), static_cast<std::uint32_t>(1 + random.below(9)), 1};
  s.crossings = static_cast<std::uint32_t>(random.below(20));
  s.path_length = random.magnitude(-3, 20);
  return s;
}

inline void take(Film& film, std::uint32_t first, std::uint32_t end) {
  const PixelWindow& w = film.window();
  for (int y = w.y0; y < w.y1; ++y) {
    for (int x = w.x0; x < w.x1; ++x) {
      for (std::uint32_t i = first; i < end; ++i) film.add(x, y, random_sample(x, y, i));
    }
  }
}

}  // namespace tenon
