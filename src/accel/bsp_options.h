#pragma once

#include "accel/bsp_tree.h"
#include "accel/options.h"

namespace tenon {

/// The options that every structure over a BSP tree takes; a leaf of 4 and a depth of 20 are Křivánek & Bubník's.
inline BspOptions take_bsp_options(AcceleratorOptions& options) {
  BspOptions bsp;
  bsp.leaf = options.take_integer("leaf", bsp.leaf, 0, 1000);
  bsp.depth = options.take_integer("depth", bsp.depth, 0, BspOptions::deepest);
  bsp.split =
      options.take_word("split", {"kaplan", "macdonald-booth"}) == 0 ? BspSplit::kaplan : BspSplit::macdonald_booth;
  return bsp;
}

/// The tree over the bounded leaves' minimum enclosures, in their hull.
inline BspTree build_bsp_tree(const CsgTree& tree, const BspOptions& options) {
  const std::vector<EnclosedLeaf> leaves = enclosed_leaves(tree);
  return build_bsp_tree(leaves, hull_of(leaves, enclosure_margin(tree)), options);
}

}  // namespace tenon
