#pragma once

namespace tenon::cells {

/// A plane across an axis.
struct SplitPlane {
  int axis = -1;  ///< -1: there is none
  double position = 0;
};

/// The i-th of evenly spaced planes through an interval: 0 is in the middle, then come those below it and those above.
/// @param beside  how many there are on either side
constexpr double evenly_spaced(double low, double high, int i, int beside) {
  const int place = i == 0 ? beside + 1 : i <= beside ? i : i + 1;
  return low + place / (2.0 * beside + 2.0) * (high - low);
}

}  // namespace tenon::cells
