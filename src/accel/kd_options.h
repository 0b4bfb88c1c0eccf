#pragma once

#include "accel/options.h"
#include "kdtree/kd_tree.h"

namespace tenon {

/// The options that every structure over kd-trees takes.
inline KdOptions take_kd_options(AcceleratorOptions& options) {
  KdOptions kd;
  kd.split = options.take_word("split", {"sah", "msah"}) == 0 ? KdSplit::sah : KdSplit::msah;
  kd.traversal_cost = options.take_number("traversal-cost", kd.traversal_cost, 0, 1e6);
  kd.depth = options.take_integer("depth", kd.depth, -1, KdTree::deepest);
  return kd;
}

}  // namespace tenon
