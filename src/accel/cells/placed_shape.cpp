#include "accel/cells/placed_shape.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "accel/cells/certainty.h"
#include "primitive/lists.h"
#include "tenon/math/rounding.h"

namespace tenon::cells {

namespace {

std::array<double, 3> array_of(const Vec3& v) {
  return {v.x, v.y, v.z};
}

std::array<double, 9> rows_of(const Affine3& map) {
  std::array<double, 9> rows{};
  std::size_t next = 0;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rows[next++] = map.row(i)[j];
  }
  return rows;
}

bool is_upright(const Affine3& map) {
  return map.row(0).y == 0 && map.row(0).z == 0 && map.row(1).x == 0 && map.row(1).z == 0 && map.row(2).x == 0 &&
         map.row(2).y == 0;
}

double square(double x) {
  return x * x;
}

class Placer {
 public:
  Placer(const CsgTree& tree, const CellScale& scale, PlacedShapes& shapes)
      : tree_(tree), scale_(scale), shapes_(shapes) {}

  ShapeRef place(const Leaf& leaf) {
    return visit(tree_.primitives.lists(), leaf.primitive, [&](const auto& primitive) {
      if constexpr (requires { add(leaf, primitive); }) {
        return add(leaf, primitive);
      } else {
        return ShapeRef(ShapeKind::general, 0);
      }
    });
  }

 private:
  ShapeRef add(const Leaf& leaf, const Sphere& sphere) {
    const Certainty certainty(leaf, scale_);
    const double e = length(certainty.place());
    const double error = e * (2 * sphere.r + e) + gamma(12) * sphere.r * sphere.r;
    if (!(e < sphere.r / 16) || !certainty.starts_are_certain(sphere.r, square(certainty.least_stretch())))
      return {ShapeKind::general, 0};
    const Placement& p = leaf.placement;
    const Affine3& map = p.local_from_world_linear();
    const double graze = certainty.graze(error), radius_square = sphere.r * sphere.r;
    if (is_upright(map)) {
      shapes_.upright_spheres.push_back(
          {array_of(p.world_origin()), {map.row(0).x, map.row(1).y, map.row(2).z}, radius_square, graze});
      return {ShapeKind::upright_sphere, shapes_.upright_spheres.size() - 1};
    }
    shapes_.spheres.push_back({array_of(p.world_origin()), rows_of(map), radius_square, graze});
    return {ShapeKind::sphere, shapes_.spheres.size() - 1};
  }

  ShapeRef add(const Leaf& leaf, const Box& box) {
    const Certainty certainty(leaf, scale_);
    const Placement& p = leaf.placement;
    const Affine3& map = p.local_from_world_linear();
    std::array<double, 3> slopes{};
    for (int i = 0; i < 3; ++i) slopes[static_cast<std::size_t>(i)] = certainty.least_slope(certainty.place()[i]);
    if (is_upright(map)) {
      shapes_.upright_boxes.push_back({array_of(p.world_center()),
                                       array_of(p.world_origin()),
                                       {map.row(0).x, map.row(1).y, map.row(2).z},
                                       array_of(box.lower()),
                                       array_of(box.upper()),
                                       slopes});
      return {ShapeKind::upright_box, shapes_.upright_boxes.size() - 1};
    }
    shapes_.boxes.push_back({array_of(p.world_center()), array_of(p.world_origin()), rows_of(map),
                             array_of(box.lower()), array_of(box.upper()), slopes});
    return {ShapeKind::box, shapes_.boxes.size() - 1};
  }

  ShapeRef add(const Leaf& leaf, const Cylinder& cylinder) {
    const Certainty certainty(leaf, scale_);
    const double e = length(Vec3{certainty.place().x, certainty.place().y, 0});
    const double r = cylinder.r, h = cylinder.h;
    const double error = e * (2 * r + e) + gamma(12) * r * r;
    // A line this steep moves aside by at most r / 8 along three heights: along one that its part between the caps
    // has, and two that its nearest point may lie off. Its component along the axis is then at least 3/4 of its length.
    const double aside = std::min(r / (8 * 4 * h), 0.5) * certainty.least_stretch();
    const double parallel = square(aside);
    if (!(e < r / 0x1p10)) return {ShapeKind::general, 0};
    const Placement& p = leaf.placement;
    shapes_.cylinders.push_back({array_of(p.world_center()), array_of(p.world_origin()),
                                 rows_of(p.local_from_world_linear()), cylinder.low(), cylinder.high(), r * r,
                                 certainty.graze(error), certainty.least_slope(certainty.place().z), parallel,
                                 square(r - r / 4), square(r + r / 4), certainty.least_certain_start(r)});
    return {ShapeKind::cylinder, shapes_.cylinders.size() - 1};
  }

  ShapeRef add(const Leaf& leaf, const Cone& cone) { return add_revolved(leaf, cone.quadric()); }
  ShapeRef add(const Leaf& leaf, const Hyperboloid& p) { return add_revolved(leaf, p.quadric()); }
  ShapeRef add(const Leaf& leaf, const Paraboloid& p) { return add_revolved(leaf, p.quadric()); }

  ShapeRef add_revolved(const Leaf& leaf, const RevolvedQuadric& q) {
    const Certainty certainty(leaf, scale_);
    const std::optional<double> graze = certainty.graze_of(q);
    if (!graze) return {ShapeKind::general, 0};
    const Placement& p = leaf.placement;
    shapes_.revolved.push_back({array_of(p.world_center()), array_of(p.world_origin()),
                                rows_of(p.local_from_world_linear()), q.offset, q.slope, q.linear, q.constant, q.low,
                                q.high, *graze, certainty.least_slope(certainty.place().z),
                                RevolvedQuadric::settled_square * square(q.greatest_radius),
                                certainty.least_certain_quadratic(q.greatest_radius, q.slope, q.linear)});
    return {ShapeKind::revolved, shapes_.revolved.size() - 1};
  }

  // The error of a plane is that of PlanesRecorder.
  ShapeRef add(const Leaf& leaf, const ConvexPolyhedron& solid) {
    const Certainty certainty(leaf, scale_);
    const Placement& p = leaf.placement;
    const std::size_t first = shapes_.planes.size();
    for (const Plane& plane : solid.planes) {
      const Vec3& n = plane.normal;
      const double error = dot(abs(n), certainty.place()) + gamma(8) * std::fabs(plane.d);
      shapes_.planes.push_back({{n.x, n.y, n.z, plane.d}, certainty.least_slope(error)});
    }
    shapes_.convex.push_back({array_of(p.world_center()), array_of(p.world_origin()),
                              rows_of(p.local_from_world_linear()), static_cast<std::uint32_t>(first),
                              static_cast<std::uint32_t>(solid.planes.size())});
    return {ShapeKind::convex, shapes_.convex.size() - 1};
  }

  // Where a line crosses a wall further than `margin` from its ends, spans() is sure that it does
  // (Prism::Line::side_of): at d from an end of it, whose normal of length 1 is n, the line passes that end at d
  // |n·direction|, which is known to within twice the error of place times the stretch of the map, for a direction of
  // length 1. By least_across, 2 e / certain, that is less as soon as d exceeds certain times the stretch.
  ShapeRef add(const Leaf& leaf, const Prism& prism) {
    const std::vector<OutlineEdge>& edges = prism.edges();
    // All are looked at here; the hierarchy that crossing_near() has is for more (by trial on text and OpenSCAD's
    // surface_image).
    constexpr std::size_t most_walls = 128;
    if (prism.scale != 1 || edges.size() > most_walls) return {ShapeKind::general, 0};
    double reach = 0;
    for (const OutlineEdge& edge : edges) {
      if (std::fabs(edge.bulge) > 1) return {ShapeKind::general, 0};
      reach = std::max(reach, length(edge.from) + length(edge.chord()));
    }
    const Certainty certainty(leaf, scale_);
    const Placement& p = leaf.placement;
    const double e = std::hypot(certainty.place().x, certainty.place().y) + gamma(8) * reach;
    const std::size_t first = shapes_.walls.size();
    for (std::size_t i = 0; i < edges.size(); ++i) {
      const OutlineEdge& edge = edges[i];
      const double chord = length(edge.chord());
      // One of no length is none.
      if (chord == 0) continue;
      const double graze = certainty.graze(Certainty::arc_error(chord, edge.bulge, e));
      shapes_.walls.push_back({edge.from, edge.chord(), edge.middle_of_chord(), chord, edge.bulge, edge.flatness(),
                               graze, edge.lower, edge.upper,
                               Prism::walls + face_of_edge(static_cast<std::uint32_t>(i), false, true)});
    }
    shapes_.prisms.push_back({array_of(p.world_center()), array_of(p.world_origin()),
                              rows_of(p.local_from_world_linear()), prism.low(), prism.high(),
                              certainty.least_slope(certainty.place().z), certainty.least_slope(2 * e),
                              8 * (certainty.most_stretch() * scale_.resolution + e), static_cast<std::uint32_t>(first),
                              static_cast<std::uint32_t>(shapes_.walls.size() - first)});
    return {ShapeKind::prism, shapes_.prisms.size() - 1};
  }

  // What is known of a crossing is known within 4 resolutions, which along the ray have to be a small part of the steps
  // of SettledTorusRoot (an eighth of one), and of the gaps between crossings: where the slope is at least
  // relative_slope 2 r |d|, and the second derivative at most 16 |d|² (|w'| <= 2 |d|, |w w''| <= 1.5 |d|², |z'| <= |d|
  // near the surface), they lie r / (2^10 |d|) apart or more. A step is at least half of r relative_step / |d|, and
  // |d| at most the stretch of the map.
  ShapeRef add(const Leaf& leaf, const Torus& torus) {
    const Certainty certainty(leaf, scale_);
    const double least_step = torus.r * SettledTorusRoot::relative_step / (2 * certainty.most_stretch());
    const double least_gap = torus.r * 0x1p-10 / certainty.most_stretch();
    if (!(4 * scale_.resolution <= std::min(least_step / 8, least_gap / 4))) return {ShapeKind::general, 0};
    const Placement& p = leaf.placement;
    shapes_.tori.push_back({array_of(p.world_center()), array_of(p.world_origin()),
                            rows_of(p.local_from_world_linear()), torus.R, torus.r});
    return {ShapeKind::torus, shapes_.tori.size() - 1};
  }

  const CsgTree& tree_;
  const CellScale& scale_;
  PlacedShapes& shapes_;
};

}  // namespace

PlacedShapes PlacedShapes::of(const CsgTree& tree, const CellScale& scale, std::span<const LeafId> order) {
  PlacedShapes shapes;
  shapes.of_leaf.resize(tree.leaves.size());
  Placer placer(tree, scale, shapes);
  for (const LeafId leaf : order) shapes.of_leaf[leaf.get()] = placer.place(tree[leaf]);
  return shapes;
}

std::size_t PlacedShapes::memory_bytes() const {
  const auto size_of = [](const auto&... lists) { return (std::span(lists).size_bytes() + ...); };
  return size_of(of_leaf, upright_spheres, spheres, upright_boxes, boxes, cylinders, revolved, convex, planes, prisms,
                 walls, tori);
}

}  // namespace tenon::cells
