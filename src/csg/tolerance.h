#pragma once

namespace tenon {

/// What the scene calls the same place.
///
/// Coordinates that a scene computes in two ways (0.1 + 0.2 here, 0.3 there) differ by a few units in the last place of
/// the largest coordinate involved. Faces nearer than this count as one; with it in the bound of both faces, features
/// down to 2^-40 of the largest coordinate are told apart (two bounds of 2^-42 each meet below 2^-41).
struct Tolerance {
  double distance = 0;

  static constexpr double relative = 0x1p-42;

  /// @param largest_coordinate  of the bounded primitives of the scene
  static constexpr Tolerance of_scene(double largest_coordinate) { return {relative * largest_coordinate}; }
};

}  // namespace tenon
