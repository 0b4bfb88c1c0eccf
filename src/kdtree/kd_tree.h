#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "tenon/math/box3.h"

namespace tenon {

/// A node of a kd-tree in 8 bytes (Havran; Zajíček 2012, §1.3.4): 1 bit that says leaf, 2 bits of axis, 29 bits of
/// index, and the plane as a float or the number of items. Children are adjacent, so one index serves for both.
class KdNode {
 public:
  static constexpr std::uint32_t index_limit = std::uint32_t{1} << 29;

  constexpr KdNode() = default;
  static constexpr KdNode inner(int axis, float plane, std::uint32_t child_below) {
    return KdNode(child_below << 3 | static_cast<std::uint32_t>(axis) << 1, std::bit_cast<std::uint32_t>(plane));
  }
  static constexpr KdNode leaf(std::uint32_t first_item, std::uint32_t item_count) {
    return KdNode(first_item << 3 | 1, item_count);
  }

  constexpr bool is_leaf() const { return (head_ & 1) != 0; }
  constexpr int axis() const { return static_cast<int>(head_ >> 1 & 3); }
  /// The child below the plane, the other follows it; of a leaf: its first item.
  constexpr std::uint32_t index() const { return head_ >> 3; }
  constexpr double plane() const { return static_cast<double>(std::bit_cast<float>(body_)); }
  constexpr std::uint32_t item_count() const { return body_; }

 private:
  constexpr KdNode(std::uint32_t head, std::uint32_t body) : head_(head), body_(body) {}

  std::uint32_t head_ = 1;
  std::uint32_t body_ = 0;
};
static_assert(sizeof(KdNode) == 8);

/// A kd-tree over numbered items. An item absent from a cell keeps the boxes' margin from it.
struct KdTree {
  Box3 box;
  std::vector<KdNode> nodes;
  std::vector<std::uint32_t> items;
  int depth = 0;

  /// The most splits on any way, whatever the options say: a traversal's stack holds as many.
  static constexpr int deepest = 60;

  std::span<const std::uint32_t> items_of(const KdNode& leaf) const {
    return {items.data() + leaf.index(), leaf.item_count()};
  }
  std::size_t memory_bytes() const {
    return nodes.capacity() * sizeof(KdNode) + items.capacity() * sizeof(std::uint32_t);
  }
};

/// What a kd-tree is built over.
struct KdItem {
  std::uint32_t item = 0;  ///< what leaves call it
  Box3 box;
  double cost = 1;  ///< of intersecting it, in tests of a sphere
};

/// Which surface area heuristic chooses the planes (Zajíček 2012).
enum class KdSplit {
  sah,  ///< eq. 1.2
  msah  ///< eq. 2.1: an item on both sides is tested once
};

struct KdOptions {
  KdSplit split = KdSplit::sah;
  double traversal_cost = 0.5;  ///< C_t, in tests of a sphere
  int depth = -1;               ///< the most splits on one way; negative: 8 + 1.3 log2(items), Havran's
};

KdTree build_kd_tree(std::span<const KdItem> items, const KdOptions& options);

}  // namespace tenon
