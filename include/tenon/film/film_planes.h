#pragma once

#include <array>
#include <cstdint>

#include "tenon/base/huge_pages.h"
#include "tenon/film/exact_sum.h"

namespace tenon {

/// What a film keeps of its pixels: a plane holds one number for each pixel of the window, row by row, and is empty
/// where the film's layers do not ask for it. On large pages a picture of one sample a pixel is not held up by the
/// system, which else has to find and clear thousands of small ones.
struct FilmPlanes {
  template <class T>
  using Plane = HugePageVector<T>;
  template <class T>
  using Three = std::array<Plane<T>, 3>;

  // Sums over the samples.
  Plane<std::uint32_t> samples;
  Three<WideSum> light;
  Plane<ShareSum> alpha;
  Three<SquareSum> squares;
  // Of those samples alone that are in the second half.
  Plane<std::uint32_t> second_samples;
  Three<WideSum> second_light;
  // Of all again.
  Three<ShareSum> normal, albedo;
  Plane<std::uint64_t> crossings;
  Plane<WideSum> path_length;

  // The sample of the lowest index, and what it met.
  Plane<std::uint32_t> first;
  Plane<float> depth;
  Three<float> point;
  Three<std::uint32_t> ids;
};

/// Calls `visit(name, plane_of)` for every plane that is a sum; `plane_of(planes)` is that plane of some FilmPlanes.
template <class Visit>
void for_each_sum(Visit&& visit) {
  visit(
      "samples", [](auto& p) -> auto& { return p.samples; });
  visit(
      "light.R", [](auto& p) -> auto& { return p.light[0]; });
  visit(
      "light.G", [](auto& p) -> auto& { return p.light[1]; });
  visit(
      "light.B", [](auto& p) -> auto& { return p.light[2]; });
  visit(
      "alpha", [](auto& p) -> auto& { return p.alpha; });
  visit(
      "squares.R", [](auto& p) -> auto& { return p.squares[0]; });
  visit(
      "squares.G", [](auto& p) -> auto& { return p.squares[1]; });
  visit(
      "squares.B", [](auto& p) -> auto& { return p.squares[2]; });
  visit(
      "second.samples", [](auto& p) -> auto& { return p.second_samples; });
  visit(
      "second.R", [](auto& p) -> auto& { return p.second_light[0]; });
  visit(
      "second.G", [](auto& p) -> auto& { return p.second_light[1]; });
  visit(
      "second.B", [](auto& p) -> auto& { return p.second_light[2]; });
  visit(
      "normal.X", [](auto& p) -> auto& { return p.normal[0]; });
  visit(
      "normal.Y", [](auto& p) -> auto& { return p.normal[1]; });
  visit(
      "normal.Z", [](auto& p) -> auto& { return p.normal[2]; });
  visit(
      "albedo.R", [](auto& p) -> auto& { return p.albedo[0]; });
  visit(
      "albedo.G", [](auto& p) -> auto& { return p.albedo[1]; });
  visit(
      "albedo.B", [](auto& p) -> auto& { return p.albedo[2]; });
  visit(
      "crossings", [](auto& p) -> auto& { return p.crossings; });
  visit(
      "path_length", [](auto& p) -> auto& { return p.path_length; });
}

/// The same for the planes of the first sample; `first` itself comes last.
template <class Visit>
void for_each_first(Visit&& visit) {
  visit(
      "depth", [](auto& p) -> auto& { return p.depth; });
  visit(
      "point.X", [](auto& p) -> auto& { return p.point[0]; });
  visit(
      "point.Y", [](auto& p) -> auto& { return p.point[1]; });
  visit(
      "point.Z", [](auto& p) -> auto& { return p.point[2]; });
  visit(
      "id.primitive", [](auto& p) -> auto& { return p.ids[0]; });
  visit(
      "id.material", [](auto& p) -> auto& { return p.ids[1]; });
  visit(
      "id.solid", [](auto& p) -> auto& { return p.ids[2]; });
  visit(
      "first", [](auto& p) -> auto& { return p.first; });
}

}  // namespace tenon
