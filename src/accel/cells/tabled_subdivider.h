#pragma once

#include <optional>
#include <span>

#include "accel/cells/leaf_pieces.h"
#include "accel/cells/split_search.h"
#include "accel/cells/subdivision.h"
#include "accel/cells/tabled_expression.h"

namespace tenon::cells {

/// Subdivides parts of space in which up to six leaves have a boundary. Their expression is a truth table, so that
/// folding it, and telling what it no longer depends on, takes a few operations on one word. That is where nearly all
/// cells of a scene come from.
class TabledSubdivider {
 public:
  explicit TabledSubdivider(const SubdivisionInput& input)
      : input_(input),
        expression_(input.ranks),
        search_(input.regions, input.scale.growth, input.quality.beside),
        pieces_(input.tree, input.scale, input.center) {}

  /// @param most_cells  when `result` holds more, nothing is split any further
  /// @return nothing where more media meet than a table can tell apart
  std::optional<Subdivision::Built> subdivide(const Box3& box, std::span<const Symbol> expression, int depth,
                                              std::size_t most_cells, Subdivision& result);

 private:
  struct Part {
    Box3 box;
    FoldedTable rest;
    Box3 tight;                  // around the boundary
    double cost = 0;             // as one cell, times the area of `tight`
    double hope = 0;             // the same if no leaf were in the way of others that have records there
    bool may_cost_less = false;  // some leaf does in smaller parts
    bool is_too_large = false;   // some leaf has pieces in smaller parts alone
    int depth = 0;
    int unpaid = 0;  // splits in a row, on the way here, that pay only if others do that follow
  };

  Subdivision::Built build(const Part& part);
  bool worth_splitting(const Part& part) const;
  Part make_part(const Box3& box, const FoldedTable& rest, int depth);
  double exact_price(const RegionLeaf& leaf, const Box3& surface) const;
  RecordRef record(LeafId leaf, const Part& part);
  ChildRef add_cell(const Part& part);

  const SubdivisionInput& input_;
  TabledExpression expression_;
  SplitSearch search_;
  LeafPieces pieces_;
  std::size_t most_cells_ = 0;
  Subdivision* result_ = nullptr;
};

}  // namespace tenon::cells
