#include "accel/cells/leaf_regions.h"

#include <cmath>

#include "accel/cells/cell_cost.h"
#include "accel/cells/leaf_pieces.h"
#include "csg/enclosures.h"
#include "math/axes.h"
#include "math/quarter_turns.h"
#include "primitive/dispatch.h"
#include "primitive/lists.h"

namespace tenon::cells {

namespace {

// How far a map may be from one that keeps angles. No length is larger than four times the largest coordinate, so this
// moves a surface by 2^-38 of that at most, which the margin covers.
constexpr double similar = 0x1p-40;

double square(double x) {
  return x * x;
}

// The scale of a map that only turns and scales alike; 0 for any other.
double similarity_scale(const Affine3& map) {
  const double a = dot(map.row(0), map.row(0));
  const double off = std::max({std::fabs(dot(map.row(1), map.row(1)) - a), std::fabs(dot(map.row(2), map.row(2)) - a),
                               std::fabs(dot(map.row(0), map.row(1))), std::fabs(dot(map.row(1), map.row(2))),
                               std::fabs(dot(map.row(2), map.row(0)))});
  return off <= similar * a ? std::sqrt(a) : 0;
}

bool maps_axes_to_axes(const Affine3& map) {
  for (int i = 0; i < 3; ++i) {
    const Vec3 row = map.row(i);
    if ((row.x != 0) + (row.y != 0) + (row.z != 0) != 1) return false;
  }
  return true;
}

// The axis of the world that z goes to, when all across it stays across and is scaled alike.
struct UprightMap {
  int axis = -1;  // none
  double scale = 0;
};
UprightMap upright(const Affine3& map) {
  const Vec3 x = map.column(0), y = map.column(1), z = map.column(2);
  for (int axis = 0; axis < 3; ++axis) {
    if (std::fabs(z[axis]) != length(z) || x[axis] != 0 || y[axis] != 0) continue;
    const double a = dot(x, x);
    if (std::max(std::fabs(dot(y, y) - a), std::fabs(dot(x, y))) <= similar * a) return {axis, std::sqrt(a)};
  }
  return {};
}

// Of the distance along one axis from a place to the nearest and the farthest point of an interval.
double nearest_square(double at, double low, double high) {
  return square(std::max(std::max(low - at, at - high), 0.0));
}
double farthest_square(double at, double low, double high) {
  return square(std::max(at - low, high - at));
}

struct SquareRange {
  double nearest = 0, farthest = 0;
};
SquareRange square_distances(const Vec3& from, const Box3& box) {
  SquareRange squares;
  for (int axis = 0; axis < 3; ++axis) {
    squares.nearest += nearest_square(from[axis], box.lower[axis], box.upper[axis]);
    squares.farthest += farthest_square(from[axis], box.lower[axis], box.upper[axis]);
  }
  return squares;
}

}  // namespace

LeafRegions::LeafRegions(const CsgTree& tree, const LeafRecords* records)
    : tree_(tree), records_(records), margin_(2 * enclosure_margin(tree)), leaves_(tree.leaves.size()) {
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Leaf& leaf = tree.leaves[i];
    RegionLeaf& region = leaves_[i];
    region.leaf = LeafId{i};
    region.bounds = leaf.bounds;
    region.extent = max_component(leaf.bounds.size());
    if (records != nullptr) {
      const double spans_cost = cost(tree.primitives, leaf.primitive), exact_price = CellCost::of_spans(spans_cost);
      region.price = static_cast<float>(CellCost::of_leaf(records->of_leaf[i].kind(), spans_cost));
      region.exact_price = static_cast<float>(exact_price);
      region.price_of_length = static_cast<float>(exact_price * (1 - window_share(tree.primitives, leaf.primitive)));
    }
    add_shape(leaf, region);
    // What has many faces has smaller features than its whole.
    constexpr double feature = 0.5;
    if (region.has_windows()) region.extent *= feature;
    region.has_pieces = records != nullptr && LeafPieces::may_have(tree, leaf);
    region.is_mesh = records != nullptr && records->of_leaf[i].kind() == RecordKind::mesh;
    // Of a mesh of more triangles what comes to planes makes rays no faster, and takes long to find (by trial).
    constexpr std::uint32_t most_faces = 128;
    if (region.is_mesh && face_count(tree.primitives, leaf.primitive).value_or(0) > most_faces) {
      region.has_pieces = false;
    }
  }
}

void LeafRegions::add_shape(const Leaf& leaf, RegionLeaf& region) {
  const Affine3& map = leaf.placement.world_from_local();
  const auto set_radius = [&](double radius) {
    region.center = map.translation();
    region.inner_square = square(std::max(radius - margin_, 0.0));
    region.outer_square = square(radius + margin_);
  };
  visit(tree_.primitives.lists(), leaf.primitive, [&]<class P>(const P& primitive) {
    if constexpr (std::is_same_v<P, Sphere>) {
      const double scale = similarity_scale(map);
      if (scale == 0) return;
      region.kind = RegionLeaf::Kind::plain;
      region.round_axes = 7;
      set_radius(scale * primitive.r);
    } else if constexpr (std::is_same_v<P, Cylinder>) {
      const UprightMap standing = upright(map);
      if (standing.axis < 0) return;
      region.kind = RegionLeaf::Kind::plain;
      region.round_axes = static_cast<std::uint8_t>(7 & ~(1 << standing.axis));
      set_radius(standing.scale * primitive.r);
    } else if constexpr (std::is_same_v<P, Torus>) {
      region.extent *= primitive.r / (primitive.R + primitive.r);
      const double scale = similarity_scale(map);
      if (scale == 0) return;
      region.kind = RegionLeaf::Kind::ring;
      set_radius(scale * primitive.r);
      region.shape = static_cast<std::uint32_t>(rings_.size());
      rings_.push_back({normalize(map.column(2)), scale * primitive.R, scale * primitive.r});
    } else if constexpr (std::is_same_v<P, TwistedPrism>) {
      // Walls are followed where the outline turns by no more than a radian (TwistedPart). Parts of a quarter of that
      // have fewer (by trial on OpenSCAD's screw), but there must not be too many of them: of a spring or a thread they
      // are larger, or too large to be of use. The finest are a sixteenth of the extent.
      constexpr double most_parts = 0x1p15;
      const double height = length(map.column(2)) * primitive.h;
      const double height_of_radian = height / (half_pi * std::fabs(primitive.twist / 90));
      const double affordable = std::sqrt(leaf.bounds.surface_area() / most_parts);
      region.has_small_pieces = records_ != nullptr && affordable <= 0.75 * height_of_radian;
      if (!region.has_small_pieces) return;
      region.extent = std::min(region.extent, 16 * std::max(0.25 * height_of_radian, affordable));
    } else if constexpr (std::is_same_v<P, Box>) {
      if (maps_axes_to_axes(map)) {
        region.kind = RegionLeaf::Kind::plain;
        region.inner_square = region.outer_square = Box3::inf;
        return;
      }
      region.kind = RegionLeaf::Kind::turned_box;
      region.center = map.point(0.5 * (primitive.lower() + primitive.upper()));
      region.shape = static_cast<std::uint32_t>(turned_boxes_.size());
      TurnedBox box;
      for (int i = 0; i < 3; ++i) {
        const Vec3 row = leaf.placement.local_from_world_linear().row(i);
        box.normals[static_cast<std::size_t>(i)] = normalize(row);
        box.half[i] = 0.5 * primitive.size[i] / length(row);
      }
      turned_boxes_.push_back(box);
    } else if constexpr (std::is_same_v<P, Instance>) {
      // Rays find where it is within the box, through cells of its own: to cut it into small ones here takes memory,
      // and makes them no faster (by trial on copies that overlap).
      if (records_ == nullptr) return;
      region.extent *= 12;
      const Box3 around = local_bounds(tree_.primitives, leaf.primitive);
      region.kind = RegionLeaf::Kind::instance;
      region.center = map.point(around.center());
      region.shape = static_cast<std::uint32_t>(leaf.prototype.get());
      half_instances_.resize(tree_.prototypes.size());
      half_instances_[region.shape] = 0.5 * around.size();
    }
  });
}

Region LeafRegions::classify(const RegionLeaf& leaf, const Box3& box) const {
  if (!leaf.bounds.overlaps(box)) return Region::outside;
  switch (leaf.kind) {
    case RegionLeaf::Kind::plain:
      return classify_plain(leaf, box);
    case RegionLeaf::Kind::ring:
      return classify_ring(leaf, box);
    case RegionLeaf::Kind::turned_box:
      return classify_turned_box(leaf, box);
    case RegionLeaf::Kind::instance:
      return classify_instance(leaf, box);
    case RegionLeaf::Kind::general:
      break;
  }
  const Leaf& placed = tree_[leaf.leaf];
  return tenon::classify(tree_.primitives, placed.primitive, placed.placement.to_local(box));
}

Region LeafRegions::classify_plain(const RegionLeaf& leaf, const Box3& box) const {
  SquareRange squares;
  bool within = true;
  for (int axis = 0; axis < 3; ++axis) {
    const double low = box.lower[axis], high = box.upper[axis];
    if (leaf.is_round_along(axis)) {
      squares.nearest += nearest_square(leaf.center[axis], low, high);
      squares.farthest += farthest_square(leaf.center[axis], low, high);
    } else {
      within = within && low >= leaf.bounds.lower[axis] + margin_ && high <= leaf.bounds.upper[axis] - margin_;
    }
  }
  if (squares.nearest > leaf.outer_square) return Region::outside;
  return within && squares.farthest < leaf.inner_square ? Region::inside : Region::straddles;
}

// As Torus::classify: the circle's point nearest to the box's centre stands for the whole circle, less what it curves
// away, which is (R / ρ_min) (v·δ)² in squares of distances.
Region LeafRegions::classify_ring(const RegionLeaf& leaf, const Box3& box) const {
  const Ring& ring = rings_[leaf.shape];
  const Vec3 half = 0.5 * box.size(), from_center = box.center() - leaf.center;
  const double along = dot(ring.axis, from_center);
  if (std::fabs(along) - dot(abs(ring.axis), half) > ring.minor + margin_) return Region::outside;
  const Vec3 radial = from_center - along * ring.axis;
  const double across = length(radial), hole_square = square(std::max(ring.major - ring.minor - margin_, 0.0));
  if (!(across > 0)) return dot(half, half) < hole_square ? Region::outside : Region::straddles;
  const Vec3 u = radial * (1 / across), v = cross(ring.axis, u);
  const double reach = dot(abs(u), half), aside = dot(abs(v), half);
  if (square(across + reach) + square(aside) < hole_square) return Region::outside;
  const SquareRange squares = square_distances(leaf.center + ring.major * u, box);
  if (squares.farthest < leaf.inner_square) return Region::inside;
  const double least_across = across - reach;
  if (!(least_across > 0)) return Region::straddles;
  const double curved = ring.major / least_across * square(aside);
  return squares.nearest - curved > leaf.outer_square ? Region::outside : Region::straddles;
}

Region LeafRegions::classify_turned_box(const RegionLeaf& leaf, const Box3& box) const {
  const TurnedBox& turned = turned_boxes_[leaf.shape];
  const Vec3 half = 0.5 * box.size(), from_center = box.center() - leaf.center;
  bool within = true;
  for (int i = 0; i < 3; ++i) {
    const Vec3& normal = turned.normals[static_cast<std::size_t>(i)];
    const double distance = std::fabs(dot(normal, from_center)), reach = dot(abs(normal), half);
    if (distance - reach > turned.half[i] + margin_) return Region::outside;
    within = within && distance + reach < turned.half[i] - margin_;
  }
  return within ? Region::inside : Region::straddles;
}

// By the box around the part, in its frame.
Region LeafRegions::classify_instance(const RegionLeaf& leaf, const Box3& box) const {
  const Affine3 map = tree_[leaf.leaf].placement.local_from_world_linear();
  const Vec3 half = 0.5 * box.size() + Vec3{margin_, margin_, margin_}, from_center = box.center() - leaf.center;
  for (int i = 0; i < 3; ++i) {
    const double distance = std::fabs(dot(map.row(i), from_center)), reach = dot(abs(map.row(i)), half);
    if (distance - reach > half_instances_[leaf.shape][i]) return Region::outside;
  }
  return Region::straddles;
}

Box3 LeafRegions::surface_within(const RegionLeaf& leaf, const Box3& box) const {
  const Box3 inside = intersection(box, grown(leaf.bounds, margin_));
  if (leaf.kind != RegionLeaf::Kind::plain || inside.is_empty()) return inside;
  Box3 surface = round_surface_within(leaf, inside);
  for (int axis = 0; axis < 3; ++axis) {
    if (!leaf.is_round_along(axis)) surface = hull(surface, face_within(leaf, inside, axis));
  }
  return surface;
}

// Of a pair of flat faces.
Box3 LeafRegions::face_within(const RegionLeaf& leaf, const Box3& box, int axis) const {
  Box3 faces;
  for (const double place : {leaf.bounds.lower[axis], leaf.bounds.upper[axis]}) {
    Box3 face = box;
    face.lower[axis] = std::max(box.lower[axis], place - margin_);
    face.upper[axis] = std::min(box.upper[axis], place + margin_);
    if (!face.is_empty()) faces = hull(faces, face);
  }
  return faces;
}

// On a ball's surface, or a cylinder's side, the square along one axis is that of the radius less those along the
// others. Each axis gains by what those before it have left of the box.
Box3 LeafRegions::round_surface_within(const RegionLeaf& leaf, const Box3& box) const {
  if (leaf.round_axes == 0) return Box3::empty();
  Box3 surface = box;
  // Squares of distances from the centre along each axis; 0 along one that is not round.
  Vec3 nearest, farthest;
  const auto measure = [&](auto axis) {
    if (!leaf.is_round_along(axis)) return;
    nearest[axis] = nearest_square(leaf.center[axis], surface.lower[axis], surface.upper[axis]);
    farthest[axis] = farthest_square(leaf.center[axis], surface.lower[axis], surface.upper[axis]);
  };
  const auto shorten = [&](auto axis) {
    if (!leaf.is_round_along(axis)) return true;
    constexpr int one = (axis + 1) % 3, other = (axis + 2) % 3;
    const double least_square = leaf.inner_square - (farthest[one] + farthest[other]);
    const double most_square = leaf.outer_square - (nearest[one] + nearest[other]);
    if (most_square < 0) return false;
    const double most = std::sqrt(most_square) + margin_;
    const double least = (least_square > 0 ? std::sqrt(least_square) : 0) - margin_;
    const double low = surface.lower[axis] - leaf.center[axis], high = surface.upper[axis] - leaf.center[axis];
    // Both halves of the surface, or the one that the box reaches.
    const double from = low < -least ? -most : least, to = high > least ? most : -least;
    surface.lower[axis] = std::max(surface.lower[axis], leaf.center[axis] + from);
    surface.upper[axis] = std::min(surface.upper[axis], leaf.center[axis] + to);
    measure(axis);
    return surface.lower[axis] <= surface.upper[axis];
  };
  for_each_axis(measure);
  return holds_for_each_axis(shorten) ? surface : Box3::empty();
}

}  // namespace tenon::cells
