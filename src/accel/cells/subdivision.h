#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "accel/cells/cell_scale.h"
#include "accel/cells/cell_store.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/leaf_regions.h"
#include "accel/cells/split_limits.h"
#include "csg/csg_tree.h"

namespace tenon::cells {

/// How much work goes into the subdivision.
struct BuildQuality {
  /// Splits that do not pay by themselves are tried so many times in a row (and once more for each doubling of what the
  /// cell costs), and taken back where what follows does not pay either.
  int look_ahead = 2;
  /// Cells are split until they are this small against the smallest of their leaves.
  double finest = 1.0 / 8;
  int beside = 1;  ///< evenly spaced planes tried on either side of the middle
};

/// How far the subdivision may go. What it leaves whole takes longer to trace; what rays meet there is the same.
struct BuildLimits {
  int depth = SplitLimits::deepest;
  std::optional<std::size_t> cells;  ///< about so many; none: in proportion to the scene
};

/// How a tree of cells is built.
struct BuildSettings {
  BuildQuality quality;
  BuildLimits limits;
  int threads = 1;
};

/// What is subdivided, and what everybody who takes part in it knows.
struct SubdivisionInput {
  const CsgTree& tree;
  const CellScale& scale;
  const LeafRecords& records;
  const LeafRegions& regions;
  const OwnerRanks& ranks;
  const Vec3& center;  ///< what records are relative to
  BuildQuality quality;
  BuildLimits limits;
};

/// A node of a subdivision: a split plane with a boundary on both sides, or what `leaf` refers to.
struct SubdivisionNode {
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  Box3 box;       ///< around the cells below
  ChildRef leaf;  ///< of one that is not split
  std::uint32_t left = none;
  std::uint32_t right = none;

  bool is_split() const { return left != none; }
};

/// A part of space cut into cells; only those with a boundary are kept.
struct Subdivision {
  std::vector<SubdivisionNode> nodes;
  CellStore store;
  int depth = 0;

  /// What a part came to: a node, or none where it has no boundary, and its expected cost times the area of its box.
  struct Built {
    std::uint32_t node = SubdivisionNode::none;
    double cost = 0;
  };

  std::uint32_t add_leaf(const Box3& box, ChildRef leaf) {
    nodes.push_back({box, leaf, SubdivisionNode::none, SubdivisionNode::none});
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }
  /// The parent of two parts; one of none leaves the other as it is.
  std::uint32_t join(std::uint32_t left, std::uint32_t right) {
    if (left == SubdivisionNode::none) return right;
    if (right == SubdivisionNode::none) return left;
    nodes.push_back({hull(nodes[left].box, nodes[right].box), {}, left, right});
    return static_cast<std::uint32_t>(nodes.size() - 1);
  }
  /// The parent of what two sides of a plane came to.
  Built join(const Built& left, const Built& right);

  /// Where it stands, to take back what is added from here on.
  struct Mark {
    std::size_t nodes;
    CellStore::Mark store;
  };
  Mark mark() const { return {nodes.size(), store.mark()}; }
  void rewind(const Mark& mark) {
    nodes.resize(mark.nodes);
    store.rewind(mark.store);
  }
};

}  // namespace tenon::cells
