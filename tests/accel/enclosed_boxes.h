#pragma once

#include "csg/enclosures.h"
#include "support/random_boxes.h"

namespace tenon::boxes {

/// As the leaves of a scene, numbered in order.
inline std::vector<EnclosedLeaf> enclosed(const std::vector<Box3>& boxes) {
  std::vector<EnclosedLeaf> leaves;
  for (std::size_t i = 0; i < boxes.size(); ++i) leaves.push_back({LeafId{i}, boxes[i]});
  return leaves;
}

}  // namespace tenon::boxes
