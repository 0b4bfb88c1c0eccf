#include "lang/convex_parts.h"

#include <algorithm>
#include <cmath>

#include "csg/tolerance.h"
#include "lang/primitive_arguments.h"
#include "mesh/convex_hull.h"
#include "plane/arc_corners.h"
#include "plane/convex_outline.h"
#include "plane/mapped_outline.h"
#include "plane/minkowski.h"
#include "plane/shape.h"
#include "primitive/convex_polyhedron.h"
#include "primitive/outline_edges.h"
#include "tenon/math/rounding.h"

namespace tenon::lang {

namespace {

// Points stand so far apart on circles, in degrees: a polyhedron of them lies within 1.6e-4 of the radius.
constexpr double step = 2;

double number(const UnionLeaf& leaf, std::size_t field) {
  return std::get<double>(leaf.values[field]);
}

/// Gathers what spans a primitive, in its own frame.
class Spanner {
 public:
  SpanningBalls span(const UnionLeaf& leaf) {
    const std::string_view kind = leaf.kind;
    if (const auto extrusion = extrusion_of(leaf)) {
      add_outline(extrusion->outline, extrusion->low, 1, 1, 0);
      add_outline(extrusion->outline, extrusion->high, 1, 1, 0);
    } else if (kind == "prism") {
      const auto [low, high] = heights(leaf, 1, 2);
      const double scale = number(leaf, 3);
      add_outline(std::get<Outline>(leaf.values[0]), low, 1, 1, 0);
      add_outline(std::get<Outline>(leaf.values[0]), high, scale, scale, 0);
    } else if (kind == "cone") {
      const auto [low, high] = heights(leaf, 0, 3);
      add_ring(low, number(leaf, 1), number(leaf, 1));
      add_ring(high, number(leaf, 2), number(leaf, 2));
    } else if (kind == "truncated_cone") {
      add_ring(0, number(leaf, 1), number(leaf, 2));
      add_ring(number(leaf, 0), number(leaf, 3), number(leaf, 4));
    } else if (kind == "hyperboloid") {
      // It is widest at its caps.
      add_ring(-number(leaf, 0) / 2, number(leaf, 1), number(leaf, 1));
      add_ring(number(leaf, 0) / 2, number(leaf, 1), number(leaf, 1));
    } else if (kind == "paraboloid") {
      constexpr int rings = 90;
      for (int i = 0; i <= rings; ++i) {
        const double part = static_cast<double>(i) / rings, r = part * number(leaf, 1);
        add_ring(part * part * number(leaf, 0), r, r);
      }
    } else if (kind == "torus") {
      for (double angle = -90; angle <= 90; angle += step) {
        const double r = number(leaf, 0) + number(leaf, 1) * cos_degrees(angle);
        add_ring(number(leaf, 1) * sin_degrees(angle), r, r);
      }
    } else if (kind == "sphere") {
      for (double angle = -90; angle <= 90; angle += step) {
        const double r = number(leaf, 0) * cos_degrees(angle);
        add_ring(number(leaf, 0) * sin_degrees(angle), r, r);
      }
    } else if (kind == "revolution") {
      for (const Vec2& p : points_of(std::get<Outline>(leaf.values[0]))) add_ring(p.y, p.x, p.x);
    } else if (kind == "twisted_prism") {
      add_twisted(leaf);
    } else if (kind == "convex_polyhedron") {
      ConvexPolyhedron polyhedron;
      polyhedron.planes = std::get<std::vector<Plane>>(leaf.values[0]);
      polyhedron.prepare();
      for (const Vec3& p : polyhedron.vertices()) add(p);
    } else if (kind == "mesh") {
      for (const Vec3& p : std::get<SharedMesh>(leaf.values[0])->vertices) add(p);
    }
    return std::move(spanning_);
  }

 private:
  static std::pair<double, double> heights(const UnionLeaf& leaf, std::size_t h, std::size_t center) {
    const double height = number(leaf, h), low = std::get<bool>(leaf.values[center]) ? -height / 2 : 0;
    return {low, low + height};
  }

  void add(const Vec3& p) { spanning_.balls.push_back({p, 0}); }

  void add_ring(double z, double a, double b) {
    if (a == 0 && b == 0) return add({0, 0, z});
    for (double angle = 0; angle < 360; angle += step) add({a * cos_degrees(angle), b * sin_degrees(angle), z});
    spanning_.exact = false;
  }

  // Of the outline's convex hull.
  std::vector<Vec2> points_of(const Outline& outline) {
    std::vector<Vec2> points;
    const OutlineEdges hull(convex_hull(outline));
    for (const OutlineEdge& edge : hull.edges()) {
      points.push_back(edge.from);
      if (!edge.is_arc()) continue;
      spanning_.exact = false;
      const Circle circle = circle_of_arc(edge.from, edge.to, edge.bulge);
      const double angle = 4 * std::atan(edge.bulge);
      const int count = static_cast<int>(std::ceil(std::fabs(angle) * (180 / std::numbers::pi) / step));
      for (int i = 1; i < count; ++i) {
        points.push_back(circle.center + turned_by(edge.from - circle.center, angle * i / count));
      }
    }
    return points;
  }

  void add_outline(const Outline& outline, double z, double scale_x, double scale_y, double degrees) {
    const double c = cos_degrees(degrees), s = sin_degrees(degrees);
    for (const Vec2& p : points_of(outline)) {
      const Vec2 q{scale_x * p.x, scale_y * p.y};
      add({c * q.x - s * q.y, s * q.x + c * q.y, z});
    }
  }

  void add_twisted(const UnionLeaf& leaf) {
    const auto [low, high] = heights(leaf, 1, 2);
    const double twist = number(leaf, 3);
    const int slices = 1 + static_cast<int>(std::fabs(twist) / step);
    for (int i = 0; i <= slices; ++i) {
      const double part = static_cast<double>(i) / slices;
      add_outline(std::get<Outline>(leaf.values[0]), low + part * (high - low), 1 + part * (number(leaf, 4) - 1),
                  1 + part * (number(leaf, 5) - 1), -part * twist);
    }
    spanning_.exact = spanning_.exact && twist == 0;
  }

  SpanningBalls spanning_;
};

// Twice the area, and six times the volume between a fan of triangles and an apex.
struct Measures {
  double area = 0, volume = 0;

  void add(const std::vector<Vec3>& points, std::span<const std::size_t> face, const Vec3& apex) {
    for (std::size_t i = 2; i < face.size(); ++i) {
      const Vec3 a = points[face[0]] - apex,
                 n = cross(points[face[i - 1]] - points[face[0]], points[face[i]] - points[face[0]]);
      area += length(n);
      volume += dot(a, n);
    }
  }
};

// A mesh is as large as its hull when it is that, but for dents that count as flat (Tolerance) and for rounding: each
// of n terms is at most the area times the diameter.
bool is_convex(const TriangleMesh& mesh) {
  const ConvexHull hull = convex_hull(mesh.vertices);
  const Vec3 apex = mesh.vertices.front();
  Measures whole, own;
  for (const auto& face : hull.faces) whole.add(hull.points, face, apex);
  double largest = 0, diameter = 0;
  for (const auto& corners : mesh.triangles) {
    const std::size_t face[] = {corners[0], corners[1], corners[2]};
    own.add(mesh.vertices, face, apex);
    for (const std::size_t i : face) {
      largest = std::max(largest, max_component(abs(mesh.vertices[i])));
      diameter = std::max(diameter, 2 * length(mesh.vertices[i] - apex));
    }
  }
  const auto terms = static_cast<int>(std::min<std::size_t>(mesh.triangles.size(), 1 << 24));
  const double slack = 3 * Tolerance::relative * largest + gamma(terms + 16) * diameter;
  return std::fabs(std::fabs(whole.volume) - own.volume) <= std::max(own.area, whole.area) * slack;
}

}  // namespace

std::optional<Extrusion> extrusion_of(const UnionLeaf& leaf) {
  const auto centered = [&](double height, bool center) {
    return center ? std::pair{-height / 2, height / 2} : std::pair{0.0, height};
  };
  if (leaf.kind == "cube") {
    const Vec3 size = std::get<Vec3>(leaf.values[0]), corner = std::get<bool>(leaf.values[1]) ? size / -2 : Vec3{};
    const double x = corner.x, y = corner.y, far_x = x + size.x, far_y = y + size.y;
    return Extrusion{{{{{x, y, 0}, {far_x, y, 0}, {far_x, far_y, 0}, {x, far_y, 0}}}}, corner.z, corner.z + size.z};
  }
  if (leaf.kind == "cylinder") {
    const auto [low, high] = centered(number(leaf, 0), std::get<bool>(leaf.values[2]));
    return Extrusion{{{full_circle({{0, 0}, number(leaf, 1)}, 1)}}, low, high};
  }
  if (leaf.kind == "prism" && number(leaf, 3) == 1) {
    const auto [low, high] = centered(number(leaf, 1), std::get<bool>(leaf.values[2]));
    return Extrusion{std::get<Outline>(leaf.values[0]), low, high};
  }
  return std::nullopt;
}

std::vector<UnionLeaf> views(const UnionLeaf& leaf) {
  if (leaf.kind != "cube") return {leaf};
  const Vec3 size = std::get<Vec3>(leaf.values[0]);
  // With x, y and z, each the next one.
  Affine3 next;
  for (std::size_t i = 0; i < 3; ++i) {
    next.m[i][i] = 0;
    next.m[(i + 1) % 3][i] = 1;
  }
  std::vector<UnionLeaf> result{leaf, leaf, leaf};
  result[1].values[0] = Vec3{size.y, size.z, size.x};
  result[1].map = leaf.map * next;
  result[2].values[0] = Vec3{size.z, size.x, size.y};
  result[2].map = leaf.map * next * next;
  return result;
}

bool keeps_z_axis(const Affine3& map) {
  const auto& m = map.m;
  const double across = std::max({std::fabs(m[0][0]), std::fabs(m[0][1]), std::fabs(m[1][0]), std::fabs(m[1][1])});
  const double along = std::fabs(m[2][2]);
  const double tilt = std::max(std::fabs(m[2][0]), std::fabs(m[2][1])),
               shear = std::max(std::fabs(m[0][2]), std::fabs(m[1][2]));
  return tilt <= turn_rounding * across && shear <= turn_rounding * along;
}

std::optional<Extrusion> aligned_extrusion(const Extrusion& extrusion, const Affine3& map) {
  const auto& m = map.m;
  if (!keeps_z_axis(map)) return std::nullopt;
  const double a = m[2][2] * extrusion.low + m[2][3], b = m[2][2] * extrusion.high + m[2][3];
  return Extrusion{mapped(extrusion.outline, map), std::min(a, b), std::max(a, b)};
}

Solid extruded(ModuleEvaluator& evaluator, const Extrusion& extrusion, const Affine3& frame, Place at) {
  if (extrusion.outline.loops.empty()) return Solid::nothing();
  const Solid prism =
      add_primitive(evaluator, at, "prism", {extrusion.outline, extrusion.high - extrusion.low, false, 1.0});
  const Affine3 map = frame * Affine3::translate({0, 0, extrusion.low});
  return map == Affine3{} ? prism : evaluator.builder().wrap(Transform{map}, {prism});
}

std::optional<double> even_scale(const Affine3& map) {
  const double size = length(map.column(0));
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const double expected = i == j ? size * size : 0;
      if (std::fabs(dot(map.column(i), map.column(j)) - expected) > turn_rounding * size * size) return std::nullopt;
    }
  }
  return size;
}

std::optional<SpanningBalls> spanning_balls(const UnionLeaf& leaf) {
  if (const auto scale = even_scale(leaf.map); scale && leaf.kind == "sphere") {
    return SpanningBalls{{{leaf.map.translation(), *scale * number(leaf, 0)}}, true};
  }
  SpanningBalls spanning = Spanner().span(leaf);
  if (spanning.balls.empty()) return std::nullopt;
  for (Ball& ball : spanning.balls) ball.center = leaf.map.point(ball.center);
  return spanning;
}

bool is_convex(const UnionLeaf& leaf) {
  if (leaf.kind == "prism") return tenon::is_convex(resolve(Shape::of(std::get<Outline>(leaf.values[0]))));
  if (leaf.kind == "mesh") return is_convex(*std::get<SharedMesh>(leaf.values[0]));
  for (const std::string_view kind :
       {"sphere", "cube", "cylinder", "cone", "truncated_cone", "paraboloid", "convex_polyhedron"}) {
    if (leaf.kind == kind) return true;
  }
  return false;
}

}  // namespace tenon::lang
