#pragma once

#include <compare>
#include <cstdint>
#include <vector>

#include "csg/csg_tree.h"

namespace tenon::cells {

/// Who owns points of the solid: nobody, the leaf of a rank, or some leaf of that rank or a worse one, all of whose
/// leaves fill space with the same medium (OwnerRanks). Of several that could own a point the least does.
struct Owner {
  std::uint32_t value = ~std::uint32_t{0};  ///< nobody; else twice the rank, and one more where it varies

  static constexpr Owner of_rank(std::uint32_t rank) { return {rank << 1}; }
  constexpr bool is_nobody() const { return value == ~std::uint32_t{0}; }
  constexpr bool varies() const { return (value & 1) != 0 && !is_nobody(); }
  constexpr std::uint32_t rank() const { return value >> 1; }
  /// It, or somebody of a worse rank.
  constexpr Owner or_worse() const { return {value | 1}; }

  friend constexpr auto operator<=>(Owner, Owner) = default;
};

/// The order in which leaves own points, as the classifier has it: by priority, then as in the tree. Leaves whose ranks
/// follow one another and that are of one medium make a group: which of them owns a point makes no boundary.
class OwnerRanks {
 public:
  /// Of a tree without media or priorities, or for those who ask for values alone.
  OwnerRanks() = default;
  /// @param tree  outlives it
  explicit OwnerRanks(const CsgTree& tree);

  /// Whether what owns a point never makes a difference to the medium.
  bool is_one_medium() const { return groups_.empty(); }
  bool is_tree_order() const { return ranks_.empty(); }

  Owner owner(LeafId leaf) const {
    return Owner::of_rank(ranks_.empty() ? static_cast<std::uint32_t>(leaf.get()) : ranks_[leaf.get()]);
  }
  /// The leaf of an owner that is one.
  LeafId leaf(Owner owner) const { return leaves_.empty() ? LeafId{owner.rank()} : leaves_[owner.rank()]; }

  /// What fills the points of an owner.
  MediumId medium(Owner owner) const {
    return is_one_medium() || owner.is_nobody() ? medium_opaque : (*tree_)[leaf(owner)].medium;
  }

  /// Whether it is known which material the points of an owner show: it is one leaf, or all that it may be have one.
  bool is_certain(Owner owner) const { return !owner.varies() || stretches_[owner.rank()] == stretches_.back(); }
  /// Whether owners that are certain show the same.
  bool show_the_same(Owner a, Owner b) const { return (*tree_)[leaf(a)].material == (*tree_)[leaf(b)].material; }

  /// Whether it may be another medium where `a` owns points that are otherwise of `b`.
  bool overrides(Owner a, Owner b) const { return !is_one_medium() && group(a) < group(b); }

 private:
  std::uint32_t group(Owner owner) const { return owner.is_nobody() ? groups_.back() : groups_[owner.rank()]; }

  const CsgTree* tree_ = nullptr;
  std::vector<std::uint32_t> ranks_;      // by leaf; empty where that is the leaf's number
  std::vector<LeafId> leaves_;            // by rank
  std::vector<std::uint32_t> stretches_;  // by rank: stretches of ranks of one material, numbered
  std::vector<std::uint32_t> groups_;     // by rank, then that of nobody; empty where there is one alone
};

}  // namespace tenon::cells
