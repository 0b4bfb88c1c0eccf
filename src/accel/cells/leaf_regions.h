#pragma once

#include <vector>

#include "csg/csg_tree.h"
#include "primitive/local_box.h"

namespace tenon::cells {

/// Tells where boxes lie with respect to the leaves: what classify() says, and for balls and upright boxes the same
/// without going through their frames, since nearly all of a build's time goes into this question.
class LeafRegions {
 public:
  explicit LeafRegions(const CsgTree& tree);

  /// @param box  of the world, bounded
  Region classify(LeafId id, const Box3& box) const;

 private:
  enum class Kind : std::uint8_t { general, ball, upright_box };
  struct Simple {
    Kind kind = Kind::general;
    Vec3 center;       // of a ball
    double inner = 0;  // a ball so large lies inside the leaf, and one so large around it
    double outer = 0;
    Box3 core;  // of an upright box: lies inside the leaf
  };

  const CsgTree& tree_;
  std::vector<Simple> simple_;  // by LeafId
};

}  // namespace tenon::cells
