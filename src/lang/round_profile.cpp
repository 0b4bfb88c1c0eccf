#include "lang/round_profile.h"

#include <algorithm>
#include <cmath>

#include "lang/primitive_arguments.h"
#include "plane/arc_corners.h"
#include "plane/mapped_outline.h"
#include "plane/outline_figures.h"

namespace tenon::lang {

std::optional<Shape> full_profile(const UnionLeaf& leaf) {
  if (leaf.kind == "cone") {
    const double h = std::get<double>(leaf.values[0]), r1 = std::get<double>(leaf.values[1]),
                 r2 = std::get<double>(leaf.values[2]), low = std::get<bool>(leaf.values[3]) ? -h / 2 : 0;
    return Shape::of({{{{-r1, low, 0}, {r1, low, 0}, {r2, low + h, 0}, {-r2, low + h, 0}}}});
  }
  if (leaf.kind == "cylinder") {
    const auto extrusion = extrusion_of(leaf);
    const double r = std::get<double>(leaf.values[1]), low = extrusion->low, high = extrusion->high;
    return Shape::of({{{{-r, low, 0}, {r, low, 0}, {r, high, 0}, {-r, high, 0}}}});
  }
  if (leaf.kind == "sphere") return Shape::of({{full_circle({{0, 0}, std::get<double>(leaf.values[0])}, 1)}});
  Outline right;
  if (leaf.kind == "torus") {
    const double center = std::get<double>(leaf.values[0]), r = std::get<double>(leaf.values[1]);
    right = {{full_circle({{center, 0}, r}, 1)}};
  } else if (leaf.kind == "revolution") {
    right = std::get<Outline>(leaf.values[0]);
  } else {
    return std::nullopt;
  }
  Outline left = right;
  for (auto& loop : left.loops) {
    for (OutlineCorner& corner : loop) corner = {-corner.x, corner.y, -corner.bulge};
  }
  return Shape{Shape::Operation::unite, {}, {Shape::of(right), Shape::of(left)}};
}

std::optional<Outline> aligned_profile(const UnionLeaf& leaf, const Affine3& map) {
  const auto profile = full_profile(leaf);
  if (!profile) return std::nullopt;
  const Outline outline = resolve(*profile);
  const auto& m = map.m;
  const double off_axis = std::max(std::fabs(m[0][3]), std::fabs(m[1][3]));
  const double size = max_component(abs(map.translation())) + length(map.column(2)) * largest_coordinate(outline);
  // Of places that were computed in two ways.
  if (off_axis > 0x1p-40 * size) return std::nullopt;
  Affine3 in_plane;
  in_plane.m[1][3] = m[2][3];
  if (const auto scale = even_scale(map); scale && leaf.kind == "sphere") {
    in_plane.m[0][0] = in_plane.m[1][1] = *scale;
    return mapped(outline, in_plane);
  }
  if (!keeps_z_axis(map)) return std::nullopt;
  const double across = length(map.column(0));
  if (std::fabs(length(map.column(1)) - across) > turn_rounding * across) return std::nullopt;
  if (std::fabs(dot(map.column(0), map.column(1))) > turn_rounding * across * across) return std::nullopt;
  in_plane.m[0][0] = across;
  in_plane.m[1][1] = m[2][2];
  if (has_arcs(outline) && !keeps_circles(in_plane)) return std::nullopt;
  return mapped(outline, in_plane);
}

Solid revolved(ModuleEvaluator& evaluator, const Outline& profile, const Affine3& frame, Place at) {
  const double far = 4 * largest_coordinate(profile);
  const Outline right_side{{{{0, -far, 0}, {far, -far, 0}, {far, far, 0}, {0, far, 0}}}};
  const Solid solid =
      add_primitive(evaluator, at, "revolution",
                    {resolve({Shape::Operation::intersect, {}, {Shape::of(profile), Shape::of(right_side)}})});
  return frame == Affine3{} ? solid : evaluator.builder().wrap(Transform{frame}, {solid});
}

}  // namespace tenon::lang
