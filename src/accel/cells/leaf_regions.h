#pragma once

#include <array>
#include <vector>

#include "accel/cells/leaf_records.h"
#include "csg/csg_tree.h"
#include "primitive/local_box.h"

namespace tenon::cells {

/// What the subdivision asks of a leaf all the time, close together in memory.
struct RegionLeaf {
  enum class Kind : std::uint8_t { general, ball, upright_box };

  Box3 bounds;
  Vec3 center;              ///< of a ball
  double inner_square = 0;  ///< of the radius of a ball that lies inside the leaf; 0: none
  double outer_square = 0;  ///< of one that the leaf lies in
  float price = 1;          ///< CellCost::of_leaf
  Kind kind = Kind::general;
  LeafId leaf;
};

/// Tells where boxes lie with respect to the leaves: what classify() says, and for balls and upright boxes the same
/// without going through their frames, since most of a build's time goes into this question.
class LeafRegions {
 public:
  /// @param records  what rays are traced with, for the prices; none: every price is 1
  explicit LeafRegions(const CsgTree& tree, const LeafRecords* records = nullptr);

  const RegionLeaf& operator[](LeafId id) const { return leaves_[id.get()]; }

  /// @param box  of the world, bounded
  Region classify(const RegionLeaf& leaf, const Box3& box) const;
  Region classify(LeafId id, const Box3& box) const { return classify(leaves_[id.get()], box); }

 private:
  friend class BoxRegions;

  const CsgTree& tree_;
  double margin_;  // twice enclosure_margin: covers the leaf's errors of place, and the roundings here
  std::vector<RegionLeaf> leaves_;
};

/// A leaf seen from one box: what each axis says is worked out once, so that parts of the box between planes across one
/// axis are told quickly.
class BoxRegions {
 public:
  BoxRegions() = default;
  BoxRegions(const LeafRegions& regions, const RegionLeaf& leaf, const Box3& box);

  /// The part of the box from `low` to `high`.
  Region classify(int axis, double low, double high) const;

 private:
  const LeafRegions* regions_ = nullptr;
  const RegionLeaf* leaf_ = nullptr;
  const Box3* box_ = nullptr;
  // What the two axes across each axis say.
  std::array<double, 3> nearest_{};  // squares of distances from a ball's centre
  std::array<double, 3> farthest_{};
  std::array<bool, 3> apart_{};  // outside whatever the part is
  std::array<bool, 3> cuts_{};   // of an upright box: never inside
};

}  // namespace tenon::cells
