#pragma once

#include <span>
#include <vector>

#include "accel/cells/cell_scale.h"
#include "accel/cells/outline_recorder.h"
#include "accel/cells/revolved_recorder.h"
#include "accel/cells/twisted_recorder.h"
#include "csg/csg_tree.h"

namespace tenon::cells {

/// What leaves of costly kinds come to within small boxes: where few faces of one go through, it is what lies below a
/// few planes, as a convex solid does, or all but that (planes_within() of the primitive), or what few walls of an
/// outline bound that is swept, twisted or turned (walls_within()).
class LeafPieces {
 public:
  /// @param center  what the records' places are relative to
  LeafPieces(const CsgTree& tree, const CellScale& scale, const Vec3& center)
      : tree_(tree), scale_(scale), center_(center) {}

  /// Whether a leaf is of a kind that has pieces at all.
  static bool may_have(const CsgTree& tree, const Leaf& leaf);

  /// Finds the piece of a leaf that stands for it within a box of the world.
  /// @return whether there is one
  bool find(LeafId leaf, const Box3& box);
  /// Of the piece that was found last: that of a piece.
  RecordKind kind() const { return kind_; }
  /// A box around its surface, within the box.
  Box3 surface() const;
  /// Whether there was none for the box being too large. Of twisted outlines.
  bool was_too_large() const { return twisted_.is_too_large; }
  /// Whether a smaller one may cost less: with fewer walls, but not with fewer planes. With up to four twisted walls
  /// the turns of rays cost more (by trial on OpenSCAD's screw and spring).
  bool may_cost_less() const {
    if (kind_ == RecordKind::twisted_piece) return twisted_.walls.size() > 4;
    return kind_ != RecordKind::convex_piece && kind_ != RecordKind::notch_piece;
  }
  /// What following it costs (CellCost).
  double price() const;
  /// The numbers of its record.
  const std::vector<double>& values();

 private:
  // By trial on OpenSCAD's examples: half as many made text slower.
  static constexpr std::size_t most_walls = 16;

  bool find_planes(const Leaf& leaf, const LocalBox& local);
  bool find_walls(const Leaf& leaf, const LocalBox& local);
  Box3 surface_of_planes() const;
  Box3 surface_of_outline() const;
  Box3 surface_of_revolved() const;
  Box3 surface_of(std::span<const Box3> parts) const;

  const CsgTree& tree_;
  const CellScale& scale_;
  const Vec3 center_;
  RecordKind kind_ = RecordKind::general;
  Box3 box_;
  std::vector<Plane> planes_;  // in the leaf's frame
  std::vector<double> values_;
  const Leaf* leaf_ = nullptr;  // of walls
  SweptPart swept_;
  TwistedPart twisted_;
  RevolvedPart turned_;
  OutlineRecorder outline_;
  TwistedRecorder twisted_record_;
  RevolvedRecorder revolved_;
};

}  // namespace tenon::cells
