#pragma once

#include <span>
#include <string>
#include <vector>

namespace tenon {

/// How values become colours.
enum class HeatScale {
  automatic,  ///< logarithmic where the largest value is more than 30 times the median, else linear
  linear,     ///< from 0
  logarithmic
};

/// A value for each pixel, to be shown as a colour.
struct HeatMap {
  int width = 0, height = 0;
  std::span<const double> values;  ///< row by row; 0 or more
  std::string title;               ///< stands in the legend, in ASCII
  HeatScale scale = HeatScale::automatic;
  double largest = 0;  ///< what the last colour stands for, and all above it; 0: the largest value
};

/// A picture of sRGB light, linear, as DisplayPicture takes it.
struct HeatMapPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

/// Draws the values in the colours of viridis, and under them a legend: the colours with numbers, the title, and which
/// scale it is. The legend's text needs some width; a narrower map stands at its left.
HeatMapPicture draw_heat_map(const HeatMap& map);

}  // namespace tenon
