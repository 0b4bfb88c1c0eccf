#include "lang/rounded_extrusion.h"

#include <cmath>
#include <numbers>

#include "lang/primitive_arguments.h"
#include "plane/arc_corners.h"
#include "plane/offset.h"
#include "plane/shape.h"

namespace tenon::lang {

namespace {

using Loop = std::vector<OutlineCorner>;

// Where two halves of one circle make a loop.
bool is_circle(const Loop& loop) {
  return loop.size() == 2 && loop[0].bulge == loop[1].bulge && std::fabs(loop[0].bulge) == 1;
}

/// What a ball sweeps that is rolled along the edges of an outline.
class Tubes {
 public:
  Tubes(ModuleEvaluator& evaluator, double radius, Place at) : evaluator_(evaluator), radius_(radius), at_(at) {}

  void follow(const Loop& loop, double z, Solids& parts) {
    if (is_circle(loop)) {
      parts.push_back(ring(circle_of_arc(place(loop[0]), place(loop[1]), loop[0].bulge), z));
      return;
    }
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 from = place(loop[i]), to = place(loop[(i + 1) % loop.size()]);
      parts.push_back(loop[i].bulge == 0 ? straight(from, to, z) : bent(from, to, loop[i].bulge, z));
      parts.push_back(moved(add_primitive(evaluator_, at_, "sphere", {radius_}), {from.x, from.y, z}));
    }
  }

 private:
  static Vec2 place(const OutlineCorner& corner) { return {corner.x, corner.y}; }

  Solid moved(const Solid& solid, const Vec3& by) {
    return evaluator_.builder().wrap(Transform{Affine3::translate(by)}, {solid});
  }

  Solid straight(const Vec2& from, const Vec2& to, double z) {
    const Vec2 way = to - from;
    const double l = length(way);
    const Vec3 along{way.x / l, way.y / l, 0}, aside{-along.y, along.x, 0};
    Affine3 map;
    for (int i = 0; i < 3; ++i) {
      auto& row = map.m[static_cast<std::size_t>(i)];
      row = {aside[i], i == 2 ? 1.0 : 0.0, along[i], i == 0 ? from.x : i == 1 ? from.y : z};
    }
    return evaluator_.builder().wrap(Transform{map}, {add_primitive(evaluator_, at_, "cylinder", {l, radius_, false})});
  }

  Solid ring(const Circle& circle, double z) {
    const Vec3 center{circle.center.x, circle.center.y, z};
    if (radius_ < circle.radius) {
      return moved(add_primitive(evaluator_, at_, "torus", {circle.radius, radius_}), center);
    }
    // The ball reaches across the axis; what lies beyond lies within what it sweeps there.
    const double far = 4 * (circle.radius + radius_);
    const Outline right{{{{0, -far, 0}, {far, -far, 0}, {far, far, 0}, {0, far, 0}}}};
    const Shape profile{Shape::Operation::intersect,
                        {},
                        {Shape::of({{full_circle({{circle.radius, 0}, radius_}, 1)}}), Shape::of(right)}};
    return moved(add_primitive(evaluator_, at_, "revolution", {resolve(profile)}), center);
  }

  // The part of a ring between two half planes from its axis.
  Solid bent(const Vec2& from, const Vec2& to, double bulge, double z) {
    const Circle circle = circle_of_arc(from, to, bulge);
    const double angle = 4 * std::atan(bulge);
    // Its corners stand far enough out that the sides between them do, too.
    const int steps = static_cast<int>(std::ceil(std::fabs(angle) / (std::numbers::pi / 3)));
    const double stretch = 2 * (1 + radius_ / circle.radius);
    Loop wedge{{circle.center.x, circle.center.y, 0}};
    for (int i = 0; i <= steps; ++i) {
      const Vec2 spoke = i == steps ? to - circle.center : turned_by(from - circle.center, angle * i / steps);
      const Vec2 corner = circle.center + stretch * spoke;
      wedge.push_back({corner.x, corner.y, 0});
    }
    const Solid sector = extruded(evaluator_, {{{wedge}}, z - 2 * radius_, z + 2 * radius_}, {}, at_);
    return evaluator_.builder().intersect({ring(circle, z), sector});
  }

  ModuleEvaluator& evaluator_;
  double radius_;
  Place at_;
};

}  // namespace

Solid rounded_extrusion(ModuleEvaluator& evaluator, const Extrusion& extrusion, double radius, Place at) {
  const Outline outline = resolve(Shape::of(extrusion.outline));
  if (outline.loops.empty()) return Solid::nothing();
  Solids parts{
      extruded(evaluator, {outline, extrusion.low - radius, extrusion.high + radius}, {}, at),
      extruded(evaluator, {offset(outline, radius, OffsetJoin::round), extrusion.low, extrusion.high}, {}, at)};
  Tubes tubes(evaluator, radius, at);
  for (const double z : {extrusion.low, extrusion.high}) {
    for (const Loop& loop : outline.loops) tubes.follow(loop, z, parts);
  }
  return evaluator.builder().unite(parts);
}

}  // namespace tenon::lang
