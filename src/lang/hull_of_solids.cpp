#include "lang/hull_of_solids.h"

#include <algorithm>
#include <cmath>

#include "lang/round_profile.h"
#include "lang/union_leaves.h"
#include "plane/convex_outline.h"

namespace tenon::lang {

namespace {

// A leaf in a frame, in one of the ways in which it is an extrusion there.
std::optional<Extrusion> extrusion_in(const Affine3& to_frame, const UnionLeaf& leaf) {
  for (const UnionLeaf& view : views(leaf)) {
    const auto extrusion = extrusion_of(view);
    if (!extrusion) return std::nullopt;
    if (auto aligned = aligned_extrusion(*extrusion, to_frame * view.map)) return aligned;
  }
  return std::nullopt;
}

// The hull of extrusions along one axis between two planes is the extrusion of the hull of their outlines.
std::optional<Solid> hull_of_extrusions(ModuleEvaluator& evaluator, const std::vector<UnionLeaf>& leaves, Place at) {
  // Cubes may stand in any frame, others in their own.
  const auto other = std::find_if(leaves.begin(), leaves.end(), [](const UnionLeaf& l) { return l.kind != "cube"; });
  const Affine3& frame = (other == leaves.end() ? leaves.begin() : other)->map;
  const auto to_frame = frame.inverse();
  if (!to_frame) return std::nullopt;
  Extrusion all;
  for (const UnionLeaf& leaf : leaves) {
    const auto aligned = extrusion_in(*to_frame, leaf);
    if (!aligned) return std::nullopt;
    if (all.outline.loops.empty()) {
      all = *aligned;
      continue;
    }
    // Of heights that were computed in two ways.
    const double near = 0x1p-40 * (std::fabs(all.low) + std::fabs(all.high));
    if (std::fabs(aligned->low - all.low) > near || std::fabs(aligned->high - all.high) > near) return std::nullopt;
    all.outline.loops.insert(all.outline.loops.end(), aligned->outline.loops.begin(), aligned->outline.loops.end());
  }
  return extruded(evaluator, {convex_hull(all.outline), all.low, all.high}, frame, at);
}

// The hull of solids of revolution around one axis is that of the hull of their profiles.
std::optional<Solid> hull_around_axis(ModuleEvaluator& evaluator, const std::vector<UnionLeaf>& leaves, Place at) {
  // A sphere may stand in any frame, others in their own.
  const auto other = std::find_if(leaves.begin(), leaves.end(), [](const UnionLeaf& l) { return l.kind != "sphere"; });
  const Affine3& frame = (other == leaves.end() ? leaves.begin() : other)->map;
  const auto to_frame = frame.inverse();
  if (!to_frame) return std::nullopt;
  Outline profiles;
  for (const UnionLeaf& leaf : leaves) {
    const auto profile = aligned_profile(leaf, *to_frame * leaf.map);
    if (!profile) return std::nullopt;
    profiles.loops.insert(profiles.loops.end(), profile->loops.begin(), profile->loops.end());
  }
  return revolved(evaluator, convex_hull(profiles), frame, at);
}

}  // namespace

Solid hull_of_solids(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
  const auto leaves = union_leaves(evaluator, solid, at);
  if (!leaves) {
    fail(at,
         "hull() of a difference or an intersection with round solids, or of more than 4,096 convex parts, is not "
         "supported yet; give what is round facets, such as $fn = 12, or take the hull of the parts");
  }
  if (leaves->empty()) return Solid::nothing();
  std::vector<Ball> balls;
  bool exact = true;
  for (const UnionLeaf& leaf : *leaves) {
    const auto spanning = spanning_balls(leaf);
    if (!spanning) fail(at, "hull() of a " + std::string(leaf.kind) + " is not supported yet");
    exact = exact && spanning->exact;
    balls.insert(balls.end(), spanning->balls.begin(), spanning->balls.end());
  }
  if (!exact) {
    if (auto extrusion = hull_of_extrusions(evaluator, *leaves, at)) return *extrusion;
    if (auto round = hull_around_axis(evaluator, *leaves, at)) return *round;
  }
  return ball_hull(evaluator, std::move(balls), at);
}

}  // namespace tenon::lang
