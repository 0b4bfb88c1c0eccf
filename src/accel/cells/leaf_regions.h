#pragma once

#include <array>
#include <vector>

#include "accel/cells/leaf_records.h"
#include "csg/csg_tree.h"
#include "primitive/local_box.h"

namespace tenon::cells {

/// What the subdivision asks of a leaf all the time, close together in memory.
struct RegionLeaf {
  enum class Kind : std::uint8_t {
    general,
    plain,  ///< a ball, an upright box or an upright cylinder: RegionLeaf says it all
    ring,
    turned_box,
    instance
  };

  Box3 bounds;
  Vec3 center;              ///< of what is round, or a turned box
  double inner_square = 0;  ///< of a radius: as far as the round axes tell, what lies nearer is inside
  double outer_square = 0;  ///< and what lies farther is outside. Both infinite for an upright box
  double extent = 0;        ///< how large its features are: the longest edge of its bounds, for a ring across its tube
  float price = 1;          ///< CellCost::of_leaf
  float exact_price = 1;    ///< CellCost::of_spans
  float price_of_length = 0;  ///< the part of that which falls with the length of the ray's way through a cell
  Kind kind = Kind::general;
  bool has_pieces = false;        ///< see LeafPieces
  bool has_small_pieces = false;  ///< only in parts that are small against the leaf
  bool is_mesh = false;           ///< told from one crossing to the next (RecordKind::mesh)
  std::uint8_t round_axes = 0;    ///< bit a: distances along axis a count. Along the others a plain leaf is its bounds
  LeafId leaf;
  std::uint32_t shape = 0;  ///< of rings and turned boxes: which; of an instance: its PrototypeId

  bool is_round_along(int axis) const { return (round_axes >> axis & 1) != 0; }
  /// Whether less has to be asked of it in a smaller cell (spans_within() of the primitive).
  bool has_windows() const { return price_of_length > 0; }
};

/// Tells where boxes lie with respect to the leaves: what classify() says, and for the commonest kinds much the same
/// without going through their frames, since most of a build's time goes into this question.
class LeafRegions {
 public:
  /// @param records  what rays are traced with, for the prices; none: every price is 1
  explicit LeafRegions(const CsgTree& tree, const LeafRecords* records = nullptr);

  const RegionLeaf& operator[](LeafId id) const { return leaves_[id.get()]; }
  /// Twice enclosure_margin: covers the leaves' errors of place, and the roundings of who uses RegionLeaf.
  double margin() const { return margin_; }

  /// @param box  of the world, bounded
  Region classify(const RegionLeaf& leaf, const Box3& box) const;
  Region classify(LeafId id, const Box3& box) const { return classify(leaves_[id.get()], box); }

  /// A box around the part of the leaf's surface that lies in a box; Box3::empty() when there is certainly none.
  Box3 surface_within(const RegionLeaf& leaf, const Box3& box) const;

 private:
  // A torus in the lengths of the world.
  struct Ring {
    Vec3 axis;
    double major = 0, minor = 0;
  };
  // Between three pairs of planes around its centre.
  struct TurnedBox {
    std::array<Vec3, 3> normals;
    Vec3 half;  // along the normals
  };

  void add_shape(const Leaf& leaf, RegionLeaf& region);
  Box3 round_surface_within(const RegionLeaf& leaf, const Box3& box) const;
  Box3 face_within(const RegionLeaf& leaf, const Box3& box, int axis) const;
  Region classify_plain(const RegionLeaf& leaf, const Box3& box) const;
  Region classify_ring(const RegionLeaf& leaf, const Box3& box) const;
  Region classify_turned_box(const RegionLeaf& leaf, const Box3& box) const;
  Region classify_instance(const RegionLeaf& leaf, const Box3& box) const;

  const CsgTree& tree_;
  const LeafRecords* records_;
  double margin_;
  std::vector<RegionLeaf> leaves_;
  std::vector<Ring> rings_;
  std::vector<TurnedBox> turned_boxes_;
  std::vector<Vec3> half_instances_;  // of the box around each prototype
};

}  // namespace tenon::cells
