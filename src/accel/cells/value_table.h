#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "accel/cells/truth_table.h"

namespace tenon::cells {

/// The value of an expression in each state of up to six leaves: a truth table, or where the solid's points are of
/// several media a number below eight that stands for one of them, bit by bit a truth table.
struct ValueTable {
  static constexpr std::size_t bits_per_value = 3, most_values = 1 << bits_per_value;

  std::array<TruthTable, bits_per_value> bits;

  constexpr bool is_binary() const { return (bits[1].word | bits[2].word) == 0; }

  constexpr std::uint32_t value(std::uint32_t state) const {
    return static_cast<std::uint32_t>((bits[0].word >> state & 1) | (bits[1].word >> state & 1) << 1 |
                                      (bits[2].word >> state & 1) << 2);
  }
  /// The states that have a value.
  constexpr std::uint64_t states(std::uint32_t value) const {
    std::uint64_t result = TruthTable::always;
    for (std::size_t b = 0; b < bits_per_value; ++b) result &= (value >> b & 1) != 0 ? bits[b].word : ~bits[b].word;
    return result;
  }
  constexpr void set(std::uint64_t states, std::uint32_t value) {
    for (std::size_t b = 0; b < bits_per_value; ++b) {
      bits[b].word = (bits[b].word & ~states) | ((value >> b & 1) != 0 ? states : 0);
    }
  }

  constexpr bool depends_on(std::size_t i) const {
    return bits[0].depends_on(i) || (!is_binary() && (bits[1].depends_on(i) || bits[2].depends_on(i)));
  }
  /// The function where a variable has a value.
  constexpr ValueTable where(std::size_t i, bool is_set) const {
    if (is_binary()) return {{bits[0].where(i, is_set)}};
    return {{bits[0].where(i, is_set), bits[1].where(i, is_set), bits[2].where(i, is_set)}};
  }

  friend constexpr bool operator==(const ValueTable&, const ValueTable&) = default;
};

}  // namespace tenon::cells
