#include "accel/cells/tabled_expression.h"

#include <algorithm>
#include <cassert>

namespace tenon::cells {

void TabledExpression::assign(std::span<const Symbol> expression) {
  leaf_count = 0;
  claims.clear();
  words_.assign(expression.size(), 0);
  std::size_t at = 0;
  value.word = tabulate(expression, at);
  at = 0;
  claim(expression, at, TruthTable::always);
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) { return a.owner.value < b.owner.value; });
}

// Recursive: an expression of six leaves is at most a few operations deep.
std::uint64_t TabledExpression::tabulate(std::span<const Symbol> expression, std::size_t& at) {
  const std::size_t place = at++;
  const Symbol& s = expression[place];
  if (s.kind == Symbol::Kind::leaf) {
    assert(leaf_count < leaves.size());
    const std::uint64_t inside = TruthTable::variable(leaf_count).word;
    leaves[leaf_count++] = s.leaf;
    return words_[place] = s.complemented ? ~inside : inside;
  }
  const bool all = s.kind == Symbol::Kind::all_of;
  std::uint64_t word = all ? TruthTable::always : 0;
  while (at < place + s.size) {
    const std::uint64_t operand = tabulate(expression, at);
    word = all ? word & operand : word | operand;
  }
  return words_[place] = word;
}

// What owns a point is true, and so is all above it; what is subtracted owns nothing.
void TabledExpression::claim(std::span<const Symbol> expression, std::size_t& at, std::uint64_t above) {
  const std::size_t place = at++;
  const Symbol& s = expression[place];
  const std::uint64_t states = above & words_[place];
  if (s.kind == Symbol::Kind::leaf) {
    if (!s.complemented) claims.push_back({Owner{s.leaf.get()}, states});
    return;
  }
  if (s.owner != Owner{}) claims.push_back({s.owner, states});
  while (at < place + s.size) claim(expression, at, states);
}

Owner TabledExpression::owner_in(std::uint64_t states) const {
  std::uint64_t left = states & value.word;
  if (left == 0) return {};
  if (!claims.empty() && claims.back().owner.value == Owner::varies && (claims.back().states & left) != 0) {
    return {Owner::varies};
  }
  Owner found;
  for (const Claim& claim : claims) {
    const std::uint64_t owned = claim.states & left;
    if (owned == 0) continue;
    if (found != Owner{} && found != claim.owner) return {Owner::varies};
    found = claim.owner;
    left &= ~owned;
  }
  return left != 0 && found != Owner{} ? Owner{Owner::varies} : found;
}

}  // namespace tenon::cells
