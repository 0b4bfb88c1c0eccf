#include "accel/cells/tabled_expression.h"

#include <algorithm>
#include <cassert>

namespace tenon::cells {

bool TabledExpression::assign(std::span<const Symbol> expression) {
  leaf_count = 0;
  claims.clear();
  words_.assign(expression.size(), 0);
  std::size_t at = 0;
  solid = tabulate(expression, at);
  at = 0;
  claim(expression, at, TruthTable::always);
  std::sort(claims.begin(), claims.end(), [](const Claim& a, const Claim& b) { return a.owner < b.owner; });
  return tell_media_apart();
}

// Numbers the media in the order of their owners, after the outside.
bool TabledExpression::tell_media_apart() {
  media = {medium_outside};
  value = {};
  const auto add = [&](MediumId medium, std::uint64_t states) {
    if (states == 0) return true;
    const auto found = std::find(media.begin(), media.end(), medium);
    const auto number = static_cast<std::uint32_t>(found - media.begin());
    if (number == ValueTable::most_values) return false;
    if (found == media.end()) media.push_back(medium);
    value.set(states, number);
    return true;
  };
  if (ranks_.is_one_medium()) return add(medium_opaque, solid);
  std::uint64_t left = solid;
  for (const Claim& claim : claims) {
    if (!add(ranks_.medium(claim.owner), claim.states & left)) return false;
    left &= ~claim.states;
  }
  return add(medium_opaque, left);
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
  std::uint64_t word = all || s.is_full ? TruthTable::always : 0;
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
    if (!s.owner.is_nobody()) claims.push_back({s.owner, states});
    return;
  }
  if (!s.owner.is_nobody()) claims.push_back({s.owner, states});
  while (at < place + s.size) claim(expression, at, states);
}

CellOwner TabledExpression::owner_in(std::uint64_t states) const {
  std::uint64_t left = states & solid;
  Owner found;
  for (const Claim& claim : claims) {
    const std::uint64_t owned = claim.states & left;
    if (owned == 0) continue;
    if (!ranks_.is_certain(claim.owner)) return CellOwner::varying();
    if (!found.is_nobody() && !ranks_.show_the_same(found, claim.owner)) return CellOwner::varying();
    found = claim.owner;
    left &= ~owned;
  }
  if (found.is_nobody()) return {};
  return left != 0 ? CellOwner::varying() : CellOwner{ranks_.leaf(found)};
}

}  // namespace tenon::cells
