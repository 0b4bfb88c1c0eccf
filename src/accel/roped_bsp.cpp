#include "accel/roped_bsp.h"

#include <utility>

namespace tenon {

namespace {

// Copies the part of a subtree that touches one face of a cell.
class RopeTreePlanter {
 public:
  RopeTreePlanter(std::vector<BspNode>& nodes, const Box3& cell, CellFace face)
      : nodes_(nodes), cell_(cell), face_(face) {}

  // Returns the root of the copy, which stands at the end of the nodes; or the node itself where nothing is pruned.
  std::uint32_t plant(std::uint32_t root) {
    root = first_that_matters(root);
    if (nodes_[root].is_leaf()) return root;
    const auto copy_of_root = static_cast<std::uint32_t>(nodes_.size());
    nodes_.emplace_back();
    pending_.push_back({root, copy_of_root});
    while (!pending_.empty()) {
      const auto [from, to] = pending_.back();
      pending_.pop_back();
      nodes_[to] = nodes_[from];
      if (nodes_[from].is_leaf()) continue;
      const auto children = static_cast<std::uint32_t>(nodes_.size());
      nodes_.resize(nodes_.size() + 2);
      nodes_[to].first = children;
      for (std::uint32_t i = 0; i < 2; ++i) {
        pending_.push_back({first_that_matters(nodes_[from].first + i), children + i});
      }
    }
    return copy_of_root;
  }

 private:
  // Follows the face's side down to a leaf or to a node whose plane cuts the face.
  std::uint32_t first_that_matters(std::uint32_t node) const {
    while (!nodes_[node].is_leaf()) {
      const FaceSide side = side_of_face(nodes_[node], cell_, face_);
      if (side == FaceSide::both) break;
      node = nodes_[node].first + (side == FaceSide::above ? 1 : 0);
    }
    return node;
  }

  struct Copy {
    std::uint32_t from, to;
  };
  std::vector<BspNode>& nodes_;
  const Box3& cell_;
  CellFace face_;
  std::vector<Copy> pending_;
};

}  // namespace

FaceSide side_of_face(const BspNode& node, const Box3& cell, CellFace face) {
  const int axis = static_cast<int>(node.axis);
  if (axis == face.axis) {
    if (face.above) return cell.upper[axis] >= node.plane ? FaceSide::above : FaceSide::below;
    return cell.lower[axis] > node.plane ? FaceSide::above : FaceSide::below;
  }
  if (cell.upper[axis] <= node.plane) return FaceSide::below;
  if (cell.lower[axis] >= node.plane) return FaceSide::above;
  return FaceSide::both;
}

RopedBsp::RopedBsp(BspTree tree)
    : box_(tree.box), depth_(tree.depth), nodes_(std::move(tree.nodes)), items_(std::move(tree.items)) {
  cells_.resize(tree.cells.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) cells_[i].content = tree.cells[i];
  place_cells();
  for (RopedCell& cell : cells_) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool above : {false, true}) {
        const CellFace face{axis, above};
        cell.ropes[face.index()] = find_neighbour_node(cell.box, face);
      }
    }
  }
}

void RopedBsp::place_cells() {
  struct Place {
    std::uint32_t node;
    Box3 box;
  };
  std::vector<Place> places{{0, box_}};
  while (!places.empty()) {
    const Place place = places.back();
    places.pop_back();
    const BspNode& node = nodes_[place.node];
    if (node.is_leaf()) {
      cells_[node.first].box = place.box;
      continue;
    }
    const int axis = static_cast<int>(node.axis);
    Place below{node.first, place.box}, above{node.first + 1, place.box};
    below.box.upper[axis] = node.plane;
    above.box.lower[axis] = node.plane;
    places.push_back(below);
    places.push_back(above);
  }
}

std::uint32_t RopedBsp::find_neighbour_node(const Box3& cell, CellFace face) const {
  const bool outermost =
      face.above ? cell.upper[face.axis] >= box_.upper[face.axis] : cell.lower[face.axis] <= box_.lower[face.axis];
  if (outermost) return RopedCell::none;
  std::uint32_t node = 0;
  while (!nodes_[node].is_leaf()) {
    const FaceSide side = side_of_face(nodes_[node], cell, face);
    if (side == FaceSide::both) break;
    node = nodes_[node].first + (side == FaceSide::above ? 1 : 0);
  }
  return node;
}

void RopedBsp::plant_rope_trees(std::size_t most) {
  for (RopedCell& cell : cells_) {
    for (int axis = 0; axis < 3; ++axis) {
      for (const bool above : {false, true}) {
        const CellFace face{axis, above};
        std::uint32_t& rope = cell.ropes[face.index()];
        if (rope == RopedCell::none || nodes_[rope].is_leaf()) continue;
        if (nodes_.size() >= most) return;
        rope = RopeTreePlanter(nodes_, cell.box, face).plant(rope);
      }
    }
  }
  nodes_.shrink_to_fit();
}

}  // namespace tenon
