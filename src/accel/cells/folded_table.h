#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "accel/cells/value_table.h"
#include "primitive/local_box.h"

namespace tenon::cells {

/// Calls body(i) for each bit i that is set, in ascending order.
template <class Body>
void for_each_bit(std::uint32_t bits, const Body& body) {
  for (; bits != 0; bits &= bits - 1) body(static_cast<std::size_t>(std::countr_zero(bits)));
}

/// Where a box lies with respect to up to six leaves, a bit each; the others straddle it.
struct TableRegions {
  std::uint32_t outside = 0, inside = 0;

  void set(std::size_t leaf, Region region) {
    outside |= static_cast<std::uint32_t>(region == Region::outside) << leaf;
    inside |= static_cast<std::uint32_t>(region == Region::inside) << leaf;
  }
};

/// What is left of a tabled expression in a part of space.
struct FoldedTable {
  ValueTable value;
  std::uint64_t possible = TruthTable::always;  ///< the states that points of the part may have
  std::uint32_t leaves = 0;                     ///< those that the value depends on, a bit each

  /// What is left in a smaller part.
  FoldedTable within(const TableRegions& regions) const {
    FoldedTable rest = *this;
    const std::uint32_t settled = (regions.outside | regions.inside) & leaves;
    if (settled == 0) return rest;
    for_each_bit(settled, [&](std::size_t i) {
      const bool inside = (regions.inside >> i & 1) != 0;
      const std::uint64_t states = TruthTable::variable(i).word;
      rest.value = rest.value.where(i, inside);
      rest.possible &= inside ? states : ~states;
    });
    rest.leaves &= ~settled;
    rest.drop_irrelevant();
    return rest;
  }

  /// Drops leaves that the value does not depend on.
  void drop_irrelevant() {
    for_each_bit(leaves, [&](std::size_t i) {
      if (!value.depends_on(i)) leaves &= ~(1U << i);
    });
  }
};

}  // namespace tenon::cells
