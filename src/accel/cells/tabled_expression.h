#pragma once

#include <array>
#include <span>
#include <vector>

#include "accel/cells/cell.h"
#include "accel/cells/local_expression.h"
#include "accel/cells/value_table.h"

namespace tenon::cells {

/// An expression of up to six leaves as a table: variable i is whether a point lies in the i-th leaf.
class TabledExpression {
 public:
  /// Who owns points of the solid, and in which states.
  struct Claim {
    Owner owner;
    std::uint64_t states = 0;
  };

  std::array<LeafId, TruthTable::most_variables> leaves;  ///< in the order of the expression
  std::size_t leaf_count = 0;
  std::uint64_t solid = 0;      ///< the states that are of the solid
  std::vector<Claim> claims;    ///< in the order of the owners; where two hold in a state the first counts
  ValueTable value;             ///< by state: whether it is of the solid, or the number of a medium
  std::vector<MediumId> media;  ///< by value; medium_outside and medium_opaque where there are no others

  /// @param ranks  outlives it
  explicit TabledExpression(const OwnerRanks& ranks) : ranks_(ranks) {}

  /// Replaces what was there.
  /// @return false where there are more media than a table can tell apart; `value` means nothing then
  bool assign(std::span<const Symbol> expression);

  /// Who owns the solid's points when only these states are possible.
  CellOwner owner_in(std::uint64_t states) const;

 private:
  std::uint64_t tabulate(std::span<const Symbol> expression, std::size_t& at);
  void claim(std::span<const Symbol> expression, std::size_t& at, std::uint64_t above);
  bool tell_media_apart();

  const OwnerRanks& ranks_;
  std::vector<std::uint64_t> words_;  // by symbol: the states in which its operation or leaf is true
};

}  // namespace tenon::cells
