#pragma once

#include "accel/cells/placed_shape.h"

namespace tenon::cells {

/// What the parts of a ray's way cost, for the surface area heuristic. The unit is the chord of an upright sphere.
struct CellCost {
  static constexpr double split = 0.45;  ///< a step down the tree
  static constexpr double visit = 0.7;   ///< a visit to a cell
  /// A leaf without a chord has the classifier follow the ray through the cell, by spans().
  static constexpr double spans_factor = 4;
  /// A cell without a table is followed by the classifier, leaf by leaf.
  static constexpr double untabled_factor = 8;

  /// @param spans_cost  of the primitive's spans() (dispatch.h), for leaves without a chord of their own
  static double of_leaf(ShapeKind kind, double spans_cost) {
    switch (kind) {
      case ShapeKind::upright_sphere:
      case ShapeKind::sphere:
        return 1;
      case ShapeKind::upright_box:
      case ShapeKind::box:
        return 1.7;
      case ShapeKind::cylinder:
        return 1.6;
      default:
        return spans_factor * spans_cost;
    }
  }
};

}  // namespace tenon::cells
