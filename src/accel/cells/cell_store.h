#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "accel/cells/cell.h"
#include "accel/cells/local_expression.h"
#include "accel/cells/wide_node.h"
#include "tenon/base/hash_index.h"
#include "tenon/base/huge_pages.h"

namespace tenon::cells {

/// Cells, and the expressions of those with more than six leaves.
struct CellStore {
  HugePageVector<Cell> cells;
  std::vector<ExtendedCell> extended;  ///< Cell::table is an index into it
  std::vector<Symbol> symbols;
  std::vector<LeafId> extended_leaves;
  std::vector<CellMedia> media;
  std::vector<LeafRecords::Line> pieces;  ///< records of what leaves come to in single cells

  /// What one of the values of a cell's table stands for.
  MediumId medium_of(const Cell& cell, std::uint32_t value) const {
    if (cell.values == Cell::Values::solid) return value != 0 ? medium_opaque : medium_outside;
    return media[cell.owner_or_media].media[value];
  }
  /// Who owns the solid's points that have it.
  CellOwner owner_of(const Cell& cell, std::uint32_t value) const {
    if (cell.values == Cell::Values::solid) return {LeafId{cell.owner_or_media}};
    return media[cell.owner_or_media].owners[value];
  }
  ValueTable values_of(const Cell& cell) const {
    if (cell.values != Cell::Values::several) return {{TruthTable{cell.table}}};
    const auto& more = media[cell.owner_or_media].more_bits;
    return {{TruthTable{cell.table}, TruthTable{more[0]}, TruthTable{more[1]}}};
  }

  std::span<const Symbol> symbols_of(const Cell& cell) const {
    if (!cell.extended) return {};
    const ExtendedCell& e = extended[cell.table];
    return {symbols.data() + e.first_symbol, e.symbol_count};
  }
  std::span<const LeafId> leaves_of(const Cell& cell) const {
    if (!cell.extended) return {cell.leaves.data(), cell.leaf_count};
    const ExtendedCell& e = extended[cell.table];
    return {extended_leaves.data() + e.first_leaf, e.leaf_count};
  }

  std::uint32_t leaf_count(const Cell& cell) const {
    return cell.extended ? extended[cell.table].leaf_count : cell.leaf_count;
  }

  ChildRef add(const Cell& cell);
  /// A cell of these media; its `owner_or_media` is filled in.
  ChildRef add(const Cell& cell, const CellMedia& media_there);
  /// A cell with more leaves than a table has room for. Where there are too many for a ray to be followed, the
  /// expression is left out.
  ChildRef add_extended(std::span<const Symbol> expression, std::uint32_t leaf_count);

  /// Has pieces be records like others, once theirs stand behind `first` of those.
  void settle_pieces(std::size_t first);

  /// Adds the cells of another store behind these.
  void append(const CellStore& part);

  struct Mark {
    std::size_t cells, extended, symbols, extended_leaves, media, pieces;
  };
  Mark mark() const {
    return {cells.size(), extended.size(), symbols.size(), extended_leaves.size(), media.size(), pieces.size()};
  }
  void rewind(const Mark& mark);

  std::size_t memory_bytes() const;

 private:
  HashIndex media_index_;  // may hold some that were taken back
};

}  // namespace tenon::cells
