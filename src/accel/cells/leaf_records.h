#pragma once

#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <vector>

#include "accel/cells/cell_scale.h"
#include "csg/csg_tree.h"
#include "tenon/base/huge_pages.h"

namespace tenon::cells {

/// The kinds of leaf that rays are followed through by plain arithmetic. A ray that meets a cell with a `general` leaf
/// is resolved by the classifier there; in one with an `instance` it is followed through the cells of that, and a
/// `mesh` is asked for one crossing after another.
///
/// A piece is what a leaf comes to in one cell (LeafPieces): a convex solid, all but one, a `notch`, or an outline of
/// few walls that is swept, `twisted` on the way, or turned, `revolved`. Until all cells are built, its record stands
/// in their store.
enum class RecordKind : std::uint8_t {
  general,
  ball,
  aligned_box,
  box,
  upright,
  frustum,
  convex,
  torus,
  notch,
  outline,
  twisted,
  revolved,
  instance,
  mesh,
  convex_piece,
  notch_piece,
  outline_piece,
  twisted_piece,
  revolved_piece
};

/// The kind of a piece whose record has come to stand with all others; any other kind is what it was.
inline RecordKind settled(RecordKind kind) {
  switch (kind) {
    case RecordKind::convex_piece:
      return RecordKind::convex;
    case RecordKind::notch_piece:
      return RecordKind::notch;
    case RecordKind::outline_piece:
      return RecordKind::outline;
    case RecordKind::twisted_piece:
      return RecordKind::twisted;
    case RecordKind::revolved_piece:
      return RecordKind::revolved;
    default:
      return kind;
  }
}

/// Whether a leaf of the kind has a record.
inline bool is_followed(RecordKind kind) {
  return kind != RecordKind::general && kind != RecordKind::instance && kind != RecordKind::mesh;
}

/// Where a leaf's record stands, and of what kind it is.
struct RecordRef {
  static constexpr int index_bits = 27;
  std::uint32_t bits = 0;

  RecordRef() = default;
  RecordRef(RecordKind kind, std::size_t index)
      : bits(static_cast<std::uint32_t>(kind) << index_bits | static_cast<std::uint32_t>(index)) {
    assert(index >> index_bits == 0);
  }
  RecordKind kind() const { return static_cast<RecordKind>(bits >> index_bits); }
  /// Into LeafRecords::lines; of an instance: its PrototypeId.
  std::uint32_t index() const { return bits & ((1U << index_bits) - 1); }
};

/// A ball: the centre, the square of its radius, and the square of half a chord below which a ray grazes it.
struct BallRecord {
  static constexpr std::size_t center = 0, square = 3, graze = 4, size = 5;
};

/// A box along the axes of the world: its ends.
struct AlignedBoxRecord {
  static constexpr std::size_t low = 0, high = 3, size = 6;
};

/// A box in a frame of its own, where it reaches from -1 to 1. A ray that is flatter to a pair of faces than `least`,
/// against its length in the world, is nearly parallel to them.
struct BoxRecord {
  static constexpr std::size_t map = 0, center = 9, least = 12, size = 15;
};

/// x² + y² <= alpha + beta z + gamma z² for low <= z <= high, around its own middle. `graze` is the discriminant over
/// |direction|² below which a ray grazes the side. One whose share across the axis, squared, is below `parallel` is
/// inside or outside as a whole, unless x² + y² lies between `inside` and `outside`. A ray that starts on the side is
/// certain of where it meets it again if x² + y² - gamma z² of its direction, over its square, exceeds `start`.
struct ProfileRecord {
  static constexpr std::size_t low = 0, high = 1, alpha = 2, beta = 3, gamma = 4, graze = 5, parallel = 6, start = 7,
                               inside = 8, outside = 9, size = 10;
};

/// A solid of revolution whose axis is the world's z: its middle, and the profile in the world's lengths.
struct UprightRecord {
  static constexpr std::size_t center = 0, profile = 3, size = profile + ProfileRecord::size;
};

/// The same in a frame of its own.
struct FrustumRecord {
  static constexpr std::size_t map = 0, center = 9, least = 12, profile = 13, size = profile + ProfileRecord::size;
};

/// Planes n·p <= d, the normals of length 1. Of a notch, whose planes bound what is not of the leaf, `count` is
/// negative.
struct ConvexRecord {
  static constexpr std::size_t count = 0, least = 1, planes = 2, plane_size = 4;
};

/// What records of outlines within a box of the world have in common (WallPart), relative to the box's middle. `known`
/// is the place of the outline's plane of which `is_inside` says whether it is inside; `least` is as in ConvexRecord.
/// Nearer than `margin` to an end of a wall, or than `place_margin` in the plane of the outline, nothing is certain.
struct WallsRecord {
  static constexpr std::size_t center = 0, map = 3, least = 12, margin = 13, place_margin = 14, known = 15,
                               is_inside = 17, count = 18, size = 19;
  /// A wall: of a place p of the plane relative to its first end, curvature |p|² + normal·p is zero on its line or
  /// circle, and about the distance near there. `place` is the one that is known, relative to that end, and `at_place`
  /// the value there. Relative to the place that is known the wall lies between `lower` and `upper`, margins included.
  struct Wall {
    static constexpr std::size_t normal = 0, chord = 2, length = 4, curvature = 5, place = 6, at_place = 8, lower = 9,
                                 upper = 11, size = 13;
  };
};

/// A swept outline (SweptPart). A place u in the leaf's frame is p = u - offset - scale_slope u.z from, from the first
/// end of a wall, and curvature |p|² + normal·p scale(u.z) = 0 is the wall's line or circle. `graze` is as in
/// ProfileRecord. A ray that starts on an arc is certain of where it meets its circle again if the coefficient of t²
/// there exceeds `start`, over the square of its direction. `index` is that of the edge.
struct OutlineRecord : WallsRecord {
  static constexpr std::size_t low = size, high = size + 1, least_to_caps = size + 2, scale = size + 3,
                               scale_slope = size + 4, known_offset = size + 5, walls = size + 7;
  // Of each wall.
  static constexpr std::size_t offset = Wall::size, from = Wall::size + 2, graze = Wall::size + 4,
                               start = Wall::size + 5, index = Wall::size + 6, wall_size = Wall::size + 7;
};

/// A twisted outline (TwistedPart), with z counted from the part's middle. `middle` is where the box's stands. `growth`
/// is the faster of the changes of scale, `reach` as in the part. Values within `doubt` may be zero.
struct TwistedRecord : WallsRecord {
  static constexpr std::size_t middle = size, low = size + 3, high = size + 4, least_to_caps = size + 5,
                               turn = size + 6, scale = size + 7, scale_slope = size + 9, growth = size + 11,
                               least_scale = size + 12, reach = size + 13, doubt = size + 14, walls = size + 15;
  // Of each wall: how steep its value may be, at most.
  static constexpr std::size_t steepness = Wall::size, wall_size = Wall::size + 1;
};

/// A turned outline (RevolvedPart), by the distance from the axis and relative to the box's middle along it. The middle
/// stands `middle` off the axis; walls are turned so that they run away from the axis, or bulge to their right.
/// `center_radius` is how far from the axis the centre of an arc is, if that is on the same side. Values within `doubt`
/// may be zero.
struct RevolvedRecord : WallsRecord {
  static constexpr std::size_t middle = size, doubt = size + 2, walls = size + 3;
  // Of each wall.
  static constexpr std::size_t center_radius = Wall::size, wall_size = Wall::size + 1;
};

/// A ring in a frame of its own: its radii, a bound on the error of TorusQuartic, and the slope of that function along
/// a ray, over the length of its direction in the world, below which a root is not certain.
struct TorusRecord {
  static constexpr std::size_t map = 0, center = 9, major = 12, minor = 13, error = 14, least = 15, size = 16;
};

/// What following a ray has to know of the leaves: numbers by kind, relative to the tree's centre, line by line of the
/// cache.
///
/// With a record, a chord is found so that it differs from that of spans() by far less than CellScale::resolution, and
/// the bounds of spans() are at most the resolution, unless it is said to be unsure.
struct LeafRecords {
  struct alignas(64) Line {
    std::array<double, 8> values{};
  };

  std::vector<RecordRef> of_leaf;  ///< by LeafId
  HugePageVector<Line> lines;      ///< leaves near to each other mostly stand near to each other
  /// A ray that is flatter than this to an axis of the world is nearly parallel to the faces across it.
  double least_slope = 0;

  const double* values(RecordRef ref) const { return lines[ref.index()].values.data(); }
  /// Whether a ray that starts on a face of the leaf is certain of where it meets that face again.
  bool start_is_certain(RecordRef ref, int on_face, const Vec3& direction) const;
  /// Whether there are directions in which it is not.
  static bool may_doubt_starts(RecordKind kind) {
    return kind == RecordKind::upright || kind == RecordKind::frustum || kind == RecordKind::outline;
  }

  std::size_t memory_bytes() const { return of_leaf.size() * sizeof(RecordRef) + lines.size() * sizeof(Line); }

  /// Has the records of pieces stand behind these. @return the index that is now of the first
  std::size_t append(const std::vector<Line>& pieces);

  /// @param order  all leaves, neighbours near to each other
  static LeafRecords of(const CsgTree& tree, const CellScale& scale, const Vec3& center, std::span<const LeafId> order);
};

}  // namespace tenon::cells
