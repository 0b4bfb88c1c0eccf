#pragma once

#include <array>
#include <span>
#include <vector>

#include "accel/cells/local_expression.h"
#include "accel/cells/truth_table.h"

namespace tenon::cells {

/// An expression of up to six leaves as a truth table: variable i is whether a point lies in the i-th leaf.
struct TabledExpression {
  /// Who owns points of the solid, and in which states.
  struct Claim {
    Owner owner;
    std::uint64_t states = 0;
  };

  std::array<LeafId, TruthTable::most_variables> leaves;  ///< in the order of the expression
  std::size_t leaf_count = 0;
  TruthTable value;
  std::vector<Claim> claims;  ///< in the order of the owners' ids; where two hold in a state the first counts

  /// Replaces what was there.
  void assign(std::span<const Symbol> expression);

  /// The owner of the solid's points when only these states are possible.
  Owner owner_in(std::uint64_t states) const;

 private:
  std::uint64_t tabulate(std::span<const Symbol> expression, std::size_t& at);
  void claim(std::span<const Symbol> expression, std::size_t& at, std::uint64_t above);

  std::vector<std::uint64_t> words_;  // by symbol: the states in which its operation or leaf is true
};

}  // namespace tenon::cells
