#pragma once

#include <algorithm>

#include "accel/cells/cell.h"
#include "accel/cells/leaf_records.h"

namespace tenon::cells {

/// What the parts of a ray's way cost, for the surface area heuristic. The unit is the stretch of a ball;
/// the prices of leaves follow the number of operations in record_chord-inl.h, the others were set by trial on the
/// bench.
struct CellCost {
  static constexpr double split = 0.45;  ///< a step down the tree
  static constexpr double visit = 0.7;   ///< a visit to a cell
  /// A leaf without a record, but for instances and meshes, has the classifier follow the ray through the cell, by
  /// spans().
  static constexpr double spans_factor = 4;
  /// What follows a ray to the next crossing of a mesh does so for all its cells: what it costs in one is in proportion
  /// to the way that the ray goes there, but no less than this share (by trial on bored and cut meshes).
  static constexpr double least_share = 0.05;
  /// A cell without a table is followed by the classifier, leaf by leaf.
  static constexpr double untabled_factor = 8;

  /// @param leaves_cost  of all its leaves together
  static double of_cell(double leaves_cost, std::size_t leaves) {
    return (visit + leaves_cost) * (leaves <= Cell::most_tabled ? 1 : untabled_factor);
  }

  /// Of a swept outline in a cell: the caps and the way to the place that is known, and each wall.
  static double of_outline(std::size_t walls) { return 3 + 1.2 * static_cast<double>(walls); }

  /// Of a twisted outline: the turns at both ends of the ray, those on the way to a crossing, and each wall.
  static double of_twisted(std::size_t walls) { return 6 + 1.2 * static_cast<double>(walls); }

  /// Of a turned outline: places on the ray, each wall, and that rays are left to the classifier which cross three.
  static double of_revolved(std::size_t walls) {
    const auto k = static_cast<double>(walls);
    return 5 + k + 0.5 * k * std::max(k - 2, 0.0);
  }

  /// @param spans_cost  of the primitive's spans() (dispatch.h), for leaves without a record
  static double of_leaf(RecordKind kind, double spans_cost) {
    switch (kind) {
      case RecordKind::ball:
        return 1;
      case RecordKind::aligned_box:
        return 0.8;
      case RecordKind::box:
        return 2;
      case RecordKind::upright:
        return 1.8;
      case RecordKind::frustum:
      case RecordKind::convex:
      case RecordKind::notch:
      case RecordKind::convex_piece:
      case RecordKind::notch_piece:
        return 2.5;
      case RecordKind::outline:
      case RecordKind::outline_piece:
        return of_outline(1);
      case RecordKind::twisted:
      case RecordKind::twisted_piece:
        return of_twisted(1);
      case RecordKind::revolved:
      case RecordKind::revolved_piece:
        return of_revolved(1);
      case RecordKind::torus:
        return 8;
      case RecordKind::instance:
      case RecordKind::mesh:
        return 20;
      case RecordKind::general:
        break;
    }
    return of_spans(spans_cost);
  }

  static double of_spans(double spans_cost) { return spans_factor * spans_cost; }
};

}  // namespace tenon::cells
