#include "lang/hull_of_solids.h"

#include <cmath>

#include "lang/convex_parts.h"
#include "plane/convex_outline.h"

namespace tenon::lang {

namespace {

// The hull of extrusions along one axis between two planes is the extrusion of the hull of their outlines.
std::optional<Solid> hull_of_extrusions(ModuleEvaluator& evaluator, const std::vector<UnionLeaf>& leaves, Place at) {
  const Affine3& frame = leaves.front().map;
  const auto to_frame = frame.inverse();
  if (!to_frame) return std::nullopt;
  Extrusion all;
  for (const UnionLeaf& leaf : leaves) {
    const auto extrusion = extrusion_of(leaf);
    if (!extrusion) return std::nullopt;
    const auto aligned = aligned_extrusion(*extrusion, *to_frame * leaf.map);
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

}  // namespace

Solid hull_of_solids(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
  const auto leaves = union_leaves(evaluator, solid, at);
  if (!leaves) {
    fail(at, "hull() of a difference or an intersection of solids is not supported yet; take the hull of its parts");
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
  }
  return ball_hull(evaluator, std::move(balls), at);
}

}  // namespace tenon::lang
