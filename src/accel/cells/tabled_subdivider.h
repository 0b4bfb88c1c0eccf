#pragma once

#include <array>
#include <vector>

#include "accel/cells/subdivision.h"
#include "accel/cells/tabled_expression.h"

namespace tenon::cells {

/// A plane across an axis.
struct SplitPlane {
  int axis = -1;  ///< -1: there is none
  double position = 0;
};

/// Subdivides parts of space in which up to six leaves have a boundary. Their expression is a truth table, so that
/// folding it, and telling what it no longer depends on, takes a few operations on one word. That is where nearly all
/// cells of a scene come from.
class TabledSubdivider {
 public:
  explicit TabledSubdivider(const SubdivisionInput& input) : input_(input) {}

  /// @param most_cells  when `result` holds more, nothing is split any further
  Subdivision::Built subdivide(const Box3& box, std::span<const Symbol> expression, int depth, std::size_t most_cells,
                               Subdivision& result);

 private:
  static constexpr std::size_t most = TruthTable::most_variables;

  // What is left of the expression in a part.
  struct Rest {
    TruthTable value;
    std::uint64_t possible = TruthTable::always;  // the states that points of the part may have
    std::uint32_t leaves = 0;                     // those that the value depends on, a bit each
  };
  struct Part {
    Box3 box;
    Rest rest;
    Box3 tight;       // around the boundary
    double cost = 0;  // as one cell, times the area of `tight`
    int depth = 0;
    int unpaid = 0;  // splits in a row, on the way here, that pay only if others do that follow
  };

  // Where a box lies with respect to the leaves, a bit each; the others straddle it.
  struct Regions {
    std::uint32_t outside = 0, inside = 0;

    void set(std::size_t leaf, Region region) {
      outside |= static_cast<std::uint32_t>(region == Region::outside) << leaf;
      inside |= static_cast<std::uint32_t>(region == Region::inside) << leaf;
    }
  };

  Subdivision::Built build(const Part& part);
  bool worth_splitting(const Part& part) const;
  void price_cells();
  SplitPlane choose_plane(const Part& part);
  void list_candidates(const Part& part, int axis);
  static Rest fold(Rest rest, const Regions& regions);
  static void drop_irrelevant(Rest& rest);
  Part make_part(const Box3& box, const Rest& rest, int depth) const;
  Part part_within(const Part& part, const Box3& box) const;
  ChildRef add_cell(const Part& part);

  const SubdivisionInput& input_;
  TabledExpression expression_;
  std::array<RegionLeaf, most> leaves_;
  std::array<double, std::size_t{1} << most> cell_cost_;  // of a cell of these leaves, a bit each
  std::size_t most_cells_ = 0;
  Subdivision* result_ = nullptr;
  std::vector<double> positions_;
};

}  // namespace tenon::cells
