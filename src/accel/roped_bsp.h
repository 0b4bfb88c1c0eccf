#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "accel/bsp_tree.h"

namespace tenon {

/// A leaf of a BSP tree with its place in space and a rope from each of its faces.
struct RopedCell {
  Box3 box;
  /// By face: 2 * axis below, 2 * axis + 1 above. The node that holds every neighbour across the face; none at the
  /// outside of the tree.
  std::array<std::uint32_t, 6> ropes{};
  BspCell content;

  static constexpr std::uint32_t none = ~std::uint32_t{0};
};

/// A face of a cell: across `axis`, below or above.
struct CellFace {
  int axis = 0;
  bool above = false;

  std::size_t index() const { return 2 * static_cast<std::size_t>(axis) + (above ? 1 : 0); }
};

/// Which neighbours across a face a node's children hold.
enum class FaceSide { below, above, both };

/// `both` when the plane of the inner node cuts the face of the cell; else the side on which the face's neighbours
/// lie. A plane that holds the face itself has them on the face's far side.
FaceSide side_of_face(const BspNode& node, const Box3& cell, CellFace face);

/// A BSP tree whose leaves know their neighbours, so that no ray ever goes back up (Křivánek & Bubník).
class RopedBsp {
 public:
  /// Ropes built as the paper says: for each face the tree is descended from the root, to the child on the face's far
  /// side, down to the first node whose plane cuts the face.
  explicit RopedBsp(BspTree tree);

  /// Replaces each rope to an inner node by its rope tree: a copy of the subtree pruned to the face. Planes parallel to
  /// the face and subtrees that do not touch it fall away, so that finding the next cell is a search in two dimensions.
  ///
  /// Where two fine partitions meet across planes of different axes, the cells on one side are each a neighbour of all
  /// on the other, and rope trees would grow like the square of the scene. Past `most` nodes in all the remaining ropes
  /// stay as they are, which costs only time.
  void plant_rope_trees(std::size_t most);

  const Box3& box() const { return box_; }
  int depth() const { return depth_; }
  /// The BSP tree's nodes, and behind them those of the rope trees; the leaf of either refers to a cell.
  const std::vector<BspNode>& nodes() const { return nodes_; }
  const std::vector<RopedCell>& cells() const { return cells_; }
  const std::vector<LeafId>& items() const { return items_; }
  std::size_t memory_bytes() const {
    return nodes_.capacity() * sizeof(BspNode) + cells_.capacity() * sizeof(RopedCell) +
           items_.capacity() * sizeof(LeafId);
  }

  /// The cell below `node` that holds a point moving along `direction`. Adds the nodes visited to `visited`.
  std::uint32_t locate(std::uint32_t node, const Vec3& point, const Vec3& direction, std::uint64_t& visited) const {
    ++visited;
    while (!nodes_[node].is_leaf()) {
      node = nodes_[node].first + side_of(nodes_[node], point, direction);
      ++visited;
    }
    return nodes_[node].first;
  }

 private:
  void place_cells();
  std::uint32_t find_neighbour_node(const Box3& cell, CellFace face) const;

  Box3 box_;
  int depth_;
  std::vector<BspNode> nodes_;
  std::vector<RopedCell> cells_;
  std::vector<LeafId> items_;
};

}  // namespace tenon
