#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "csg/tolerance.h"
#include "primitive/placement.h"
#include "tenon/base/id.h"
#include "tenon/csg/hit.h"
#include "tenon/csg/scene_graph.h"
#include "tenon/math/box3.h"

namespace tenon {

using CsgNodeId = Id<struct CsgNode_>;
using PrototypeId = Id<struct Prototype_>;
using ColorId = Id<struct Color_>;

class Prototype;

/// A primitive with everything pushed to it: its place in the world and its attributes (Zajíček 2012, §2.2, the
/// "combined attribute node").
struct Leaf {
  PrimitiveId primitive;
  Placement placement;
  Box3 bounds;          ///< of the whole primitive, in the world
  CsgNodeId node;       ///< where it stands in the tree
  MaterialId material;  ///< the nearest `material`; none when there is none
  ColorId color;        ///< the outermost `color`, in CsgTree::colors; none when there is none
  MediumId medium = medium_opaque;
  double priority = 0;             ///< of its material, where media overlap
  bool shows_what_it_cut = false;  ///< it is subtracted, and its faces show the material of what it was taken from
  PrototypeId prototype{};         ///< what the primitive is an instance of; none for a primitive of the scene
};

enum class CsgOperation : std::uint8_t { leaf, union_, intersection, difference, complement };

/// A node of the tree as it was modelled, n-ary, without attributes.
struct CsgNode {
  CsgOperation operation = CsgOperation::union_;
  CsgNodeId parent;               ///< none for the root
  std::uint32_t first_child = 0;  ///< into CsgTree::children
  std::uint32_t child_count = 0;
  LeafId leaf;
};

/// The scene as a Boolean expression over placed primitives. Children come before their parents in `nodes`; leaves are
/// numbered in tree order (depth first, first operand first).
struct CsgTree {
  PrimitiveStore primitives;
  std::vector<CsgNode> nodes;
  std::vector<CsgNodeId> children;
  std::vector<Leaf> leaves;
  std::vector<Rgba> colors;
  std::vector<std::shared_ptr<Prototype>> prototypes;
  CsgNodeId root;
  Tolerance tolerance;
  bool has_media = false;  ///< some leaf is transparent: boundaries lie between media, not only at the outside

  const CsgNode& operator[](CsgNodeId id) const { return nodes[id.get()]; }
  const Leaf& operator[](LeafId id) const { return leaves[id.get()]; }
  std::span<const CsgNodeId> children_of(const CsgNode& node) const {
    return {children.data() + node.first_child, node.child_count};
  }

  /// Nodes on the longest way from the root to a leaf.
  int depth() const;
};

}  // namespace tenon
