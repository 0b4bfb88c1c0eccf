#pragma once

#include <array>
#include <cstdint>

#include "accel/cells/leaf_records.h"

namespace tenon::cells {

/// A cell in one cache line. With up to six leaves the whole expression is one word: bit s of `table` is the value of a
/// point that lies in the leaves whose bits are set in s.
struct alignas(64) Cell {
  static constexpr std::size_t most_tabled = 6;
  /// A ray that meets a cell with more leaves is left to the exact structure.
  static constexpr std::size_t most_followed = 64;

  std::uint64_t table = 0;
  std::array<RecordRef, most_tabled> records;
  std::array<LeafId, most_tabled> leaves;
  std::uint8_t leaf_count = 0;
  bool general = false;   ///< some leaf has no record
  bool extended = false;  ///< more than six leaves: the expression stands in CellTree::symbols
  std::uint32_t owner =
      0;  ///< Owner::value of the points of the solid here; Owner::varies: it takes the exact structure
};

/// The expression of a cell with more than six leaves.
struct ExtendedCell {
  std::uint32_t first_symbol = 0;
  std::uint32_t symbol_count = 0;
  std::uint32_t first_leaf = 0;
  std::uint32_t leaf_count = 0;
};

}  // namespace tenon::cells
