#include "accel/cells/owner_ranks.h"

#include <algorithm>

namespace tenon::cells {

OwnerRanks::OwnerRanks(const CsgTree& tree) : tree_(&tree) {
  const std::size_t count = tree.leaves.size();
  const auto precedes = [&](const Leaf& a, const Leaf& b) { return a.priority > b.priority; };
  if (!std::is_sorted(tree.leaves.begin(), tree.leaves.end(), precedes)) {
    leaves_.reserve(count);
    for (std::size_t i = 0; i < count; ++i) leaves_.emplace_back(i);
    std::stable_sort(leaves_.begin(), leaves_.end(), [&](LeafId a, LeafId b) { return precedes(tree[a], tree[b]); });
    ranks_.resize(count);
    for (std::size_t rank = 0; rank < count; ++rank) ranks_[leaves_[rank].get()] = static_cast<std::uint32_t>(rank);
  }
  stretches_.resize(count);
  for (std::size_t rank = 1; rank < count; ++rank) {
    const Owner here = Owner::of_rank(static_cast<std::uint32_t>(rank));
    const Owner before = Owner::of_rank(static_cast<std::uint32_t>(rank - 1));
    stretches_[rank] = stretches_[rank - 1] + (show_the_same(before, here) ? 0 : 1);
  }
  if (!tree.has_media) return;
  groups_.resize(count + 1);
  const auto medium_at = [&](std::size_t rank) {
    return rank == count ? medium_opaque : tree[leaf(Owner::of_rank(static_cast<std::uint32_t>(rank)))].medium;
  };
  for (std::size_t rank = 1; rank <= count; ++rank) {
    groups_[rank] = groups_[rank - 1] + (medium_at(rank) != medium_at(rank - 1) ? 1 : 0);
  }
}

}  // namespace tenon::cells
