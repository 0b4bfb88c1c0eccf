#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

#include "accel/cells/leaf_records.h"
#include "accel/cells/value_table.h"
#include "tenon/csg/hit.h"

namespace tenon::cells {

/// The leaf that owns points of the solid, or one of several whose material is the same; none where nobody does.
struct CellOwner {
  LeafId leaf;

  /// Leaves of different materials own them: which one, the exact structure knows.
  static constexpr CellOwner varying() { return {LeafId{LeafId::none_value - 1}}; }
  constexpr bool varies() const { return *this == varying(); }
  friend constexpr bool operator==(CellOwner, CellOwner) = default;
};

/// What the values of a cell's points stand for, where there are media.
struct CellMedia {
  std::array<MediumId, ValueTable::most_values> media{};
  std::array<CellOwner, ValueTable::most_values> owners{};
  std::array<std::uint64_t, ValueTable::bits_per_value - 1> more_bits{};  ///< of the values, where there are several

  friend bool operator==(const CellMedia&, const CellMedia&) = default;
};

/// A cell in one cache line. With up to six leaves the whole expression is one word: bit s of `table` is the value of a
/// point that lies in the leaves whose bits are set in s.
struct alignas(64) Cell {
  static constexpr std::size_t most_tabled = 6;
  /// A ray that meets a cell with more leaves is left to the exact structure.
  static constexpr std::size_t most_followed = 64;

  enum class Values : std::uint8_t {
    solid,    ///< 1 in the solid, which is opaque, 0 outside
    pair,     ///< one each for two media, told by CellStore::media
    several,  ///< more of them; the higher bits of a value stand there, too
  };

  std::uint64_t table = 0;
  std::array<RecordRef, most_tabled> records;
  std::array<LeafId, most_tabled> leaves;
  std::uint8_t leaf_count = 0;
  bool general : 1 = false;     ///< some leaf has no record
  bool successive : 1 = false;  ///< all of those tell their crossings one after another
  bool extended = false;        ///< more than six leaves: the expression stands in CellTree::symbols
  Values values = Values::solid;
  /// Of Values::solid: who owns the solid's points here. Else an index into CellStore::media.
  std::uint32_t owner_or_media = CellOwner{}.leaf.get();
};
static_assert(sizeof(Cell) == 64);

/// Whether meshes are all that keeps a cell from being followed by its table.
inline bool is_of_meshes(const Cell& cell) {
  if (!cell.successive || cell.extended) return false;
  const auto records = std::span(cell.records).first(cell.leaf_count);
  return std::ranges::none_of(records, [](const RecordRef& ref) { return ref.kind() == RecordKind::instance; });
}

/// The expression of a cell with more than six leaves.
struct ExtendedCell {
  std::uint32_t first_symbol = 0;
  std::uint32_t symbol_count = 0;
  std::uint32_t first_leaf = 0;
  std::uint32_t leaf_count = 0;
};

}  // namespace tenon::cells
