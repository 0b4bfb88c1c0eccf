#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tenon::cells {

/// A Boolean function of up to six variables in one word: bit s is its value in the state s, whose bit i is variable i.
/// A function of fewer variables depends on none of the others.
struct TruthTable {
  static constexpr std::size_t most_variables = 6;
  static constexpr std::uint64_t always = ~std::uint64_t{0};

  std::uint64_t word = 0;

  /// The states in which a variable is set: the table of the variable itself.
  static constexpr TruthTable variable(std::size_t i) {
    constexpr std::array<std::uint64_t, most_variables> words{0xaaaaaaaaaaaaaaaa, 0xcccccccccccccccc,
                                                              0xf0f0f0f0f0f0f0f0, 0xff00ff00ff00ff00,
                                                              0xffff0000ffff0000, 0xffffffff00000000};
    return {words[i]};
  }

  constexpr bool is_constant() const { return word == 0 || word == always; }
  constexpr bool depends_on(std::size_t i) const {
    return ((word ^ word >> (std::size_t{1} << i)) & ~variable(i).word) != 0;
  }
  /// The function where a variable has a value (its cofactor).
  constexpr TruthTable where(std::size_t i, bool value) const {
    const std::size_t shift = std::size_t{1} << i;
    const std::uint64_t kept = value ? word & variable(i).word : word & ~variable(i).word;
    return {kept | (value ? kept >> shift : kept << shift)};
  }

  friend constexpr bool operator==(TruthTable, TruthTable) = default;
};

}  // namespace tenon::cells
