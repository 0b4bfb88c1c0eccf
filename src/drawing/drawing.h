#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "math/vec2.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// A segment or an arc on a layer.
struct Stroke {
  Vec2 from, to;
  double bulge = 0;  ///< as OutlineCorner's
  std::uint32_t layer = 0;
};

/// A dimension of a drawing, as DXF has it.
struct Dimension {
  std::string name;
  std::uint32_t layer = 0;
  int type = 0;
  double angle = 0;            ///< in degrees
  std::array<Vec2, 7> points;  ///< of the group codes 10 to 16
};

/// What a drawing file says, in its own order and coordinates.
struct Drawing {
  std::vector<std::string> layers;
  std::vector<Stroke> strokes;
  std::vector<Dimension> dimensions;
  std::vector<std::string> notes;  ///< what was left out, for a warning each

  /// Whether a stroke or a dimension on a layer is asked for by the layer's name; by none, all are.
  bool is_on(std::uint32_t layer, const std::string& name) const { return name.empty() || layers[layer] == name; }
};

}  // namespace tenon
