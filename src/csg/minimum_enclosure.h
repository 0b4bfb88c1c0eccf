#pragma once

#include <vector>

#include "csg/csg_tree.h"
#include "tenon/math/box3.h"

namespace tenon {

/// A box around the solid of every node, from those of the leaves: the hull for a union, what all share for an
/// intersection, the first operand's for a difference, everything for a complement (course, "Hierarchy: CSG model").
std::vector<Box3> node_enclosures(const CsgTree& tree);
/// The same from other boxes around the leaves, by LeafId, such as boxes along other axes.
std::vector<Box3> node_enclosures(const CsgTree& tree, const std::vector<Box3>& leaf_boxes);

/// The minimum enclosure of every leaf: the part of its box that is effectively used (Bouatouch et al. 1987, RR-612
/// §3.1). The leaf's box is cut by the enclosure of each node on the way up to the root. The paper walks up from every
/// leaf; walking down from the root once gives the same boxes, and stays linear when the tree is a list.
///
/// @param enclosures  what node_enclosures() returns for this tree
/// @return by LeafId; empty where the leaf cannot matter
std::vector<Box3> minimum_enclosures(const CsgTree& tree, const std::vector<Box3>& enclosures);

}  // namespace tenon
