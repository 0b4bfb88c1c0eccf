#pragma once

#include <optional>
#include <string>
#include <vector>

#include "lang/ball_hull.h"
#include "primitive/arc.h"

namespace tenon::lang {

/// A primitive of a solid that is a union, where the transformations put it.
struct UnionLeaf {
  std::string_view kind;
  std::vector<FieldValue> values;
  Affine3 map;  ///< of the primitive into the solid
};

/// An outline swept along the z axis of its primitive.
struct Extrusion {
  Outline outline;
  double low = 0, high = 0;
};
/// A cube, a cylinder or a straight prism as one; nothing for others.
std::optional<Extrusion> extrusion_of(const UnionLeaf& leaf);

/// A primitive in every way in which it is an extrusion along z: a cube is one along each of its edges.
std::vector<UnionLeaf> views(const UnionLeaf& leaf);

/// What a few rotations round, against the size of what is turned: maps that differ by less are one.
inline constexpr double turn_rounding = 0x1p-42;

/// Whether a map keeps the direction of the z axis and planes across it, but for rounding.
bool keeps_z_axis(const Affine3& map);

/// An extrusion under a map that keeps the z axis and planes across it, but for rounding; nothing under others.
std::optional<Extrusion> aligned_extrusion(const Extrusion& extrusion, const Affine3& map);

/// The solid of an extrusion in a frame.
Solid extruded(ModuleEvaluator& evaluator, const Extrusion& extrusion, const Affine3& frame, Place at);

/// The factor by which a map scales, where it does so evenly, but for rounding.
std::optional<double> even_scale(const Affine3& map);

/// Balls and points whose convex hull is that of a primitive.
struct SpanningBalls {
  std::vector<Ball> balls;
  bool exact = true;  ///< false where points stand for curves, 2 degrees apart on circles
};
/// Nothing for primitives that have no such hull here: those without end, algebraic surfaces and patches.
std::optional<SpanningBalls> spanning_balls(const UnionLeaf& leaf);

/// Whether a primitive is convex, as far as its kind tells.
bool is_convex(const UnionLeaf& leaf);

}  // namespace tenon::lang
