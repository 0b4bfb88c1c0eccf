#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "tenon/render/cost_map.h"

namespace tenon {

/// One of the costs of a pixel, as it is drawn.
struct CostKind {
  std::string_view name;    ///< as `--heatmap` calls it
  std::string_view legend;  ///< after the structure's name
  std::vector<double> CostMap::*costs;
  double scale;  ///< from the map's unit to the legend's

  std::vector<double> values(const CostMap& map) const {
    std::vector<double> scaled = map.*costs;
    for (double& v : scaled) v *= scale;
    return scaled;
  }
};
inline constexpr std::array<CostKind, 3> cost_kinds{{{"tests", "primitive tests a pixel", &CostMap::primitive_tests, 1},
                                                     {"cells", "cells visited a pixel", &CostMap::cells_visited, 1},
                                                     {"time", "microseconds a pixel", &CostMap::seconds, 1e6}}};

}  // namespace tenon
