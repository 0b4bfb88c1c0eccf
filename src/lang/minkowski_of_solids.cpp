#include "lang/minkowski_of_solids.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lang/polyhedral_parts.h"
#include "lang/round_profile.h"
#include "lang/rounded_extrusion.h"
#include "lang/union_leaves.h"
#include "plane/minkowski.h"
#include "plane/offset.h"
#include "plane/shape.h"

namespace tenon::lang {

namespace {

// More pairs than a scene can mean.
constexpr std::size_t most_pairs = 100'000;

/// A primitive with what it can be taken for.
struct Summand {
  UnionLeaf leaf;
  std::optional<SpanningBalls> balls;  // where it is convex

  bool is_exact() const { return balls && balls->exact; }
};

Summand summand_of(const UnionLeaf& leaf) {
  return {leaf, is_convex(leaf) ? spanning_balls(leaf) : std::nullopt};
}

std::vector<Summand> summands_of(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
  const auto leaves = union_leaves(evaluator, solid, at);
  if (!leaves) {
    fail(at,
         "minkowski() of a difference or an intersection with round solids, or of more than 4,096 convex parts, is "
         "not supported yet; give what is round facets, such as $fn = 12, or take it of the parts");
  }
  std::vector<Summand> summands;
  std::transform(leaves->begin(), leaves->end(), std::back_inserter(summands), summand_of);
  return summands;
}

std::vector<Ball> sums(const std::vector<Ball>& a, const std::vector<Ball>& b) {
  std::vector<Ball> result;
  for (const Ball& p : a) {
    for (const Ball& q : b) result.push_back({p.center + q.center, p.radius + q.radius});
  }
  return result;
}

Affine3 with_translation(Affine3 map, const Vec3& t) {
  for (int i = 0; i < 3; ++i) map.m[static_cast<std::size_t>(i)][3] = t[i];
  return map;
}

/// The sum of two primitives.
class PairSum {
 public:
  PairSum(ModuleEvaluator& evaluator, Place at) : evaluator_(evaluator), at_(at) {}

  Solid sum(const Summand& a, const Summand& b) {
    if (a.is_exact() && b.is_exact()) return ball_hull(evaluator_, sums(a.balls->balls, b.balls->balls), at_);
    if (auto solid = sum_of_extrusions(a.leaf, b.leaf)) return *solid;
    if (auto solid = sum_with_sphere(a.leaf, b.leaf)) return *solid;
    if (auto solid = sum_with_sphere(b.leaf, a.leaf)) return *solid;
    if (auto solid = rounded(a.leaf, b.leaf)) return *solid;
    if (auto solid = rounded(b.leaf, a.leaf)) return *solid;
    if (auto solid = sum_of_parts(a, b)) return *solid;
    require_convex(a);
    require_convex(b);
    if (a.balls->balls.size() * b.balls->balls.size() > most_pairs) {
      fail(at_, "minkowski() of these round solids would have too many points; give one of them a small $fn");
    }
    return ball_hull(evaluator_, sums(a.balls->balls, b.balls->balls), at_);
  }

 private:
  void require_convex(const Summand& summand) const {
    if (summand.balls) return;
    fail(at_, "minkowski() of a " + std::string(summand.leaf.kind) +
                  " that is not convex is not supported yet; make it a union of convex parts");
  }

  std::optional<Solid> sum_of_extrusions(const UnionLeaf& a, const UnionLeaf& b) {
    for (const UnionLeaf& along : views(a)) {
      for (const UnionLeaf& with : views(b)) {
        if (auto solid = sum_along(along, with)) return solid;
      }
    }
    return std::nullopt;
  }

  // Of what is not convex, but has flat faces: the sums of its convex parts.
  std::optional<Solid> sum_of_parts(const Summand& a, const Summand& b) {
    if (a.balls && b.balls) return std::nullopt;
    const auto first = convex_summands(a), second = convex_summands(b);
    if (!first || !second) return std::nullopt;
    if (first->size() * second->size() > most_pairs) {
      fail(at_, "minkowski() of these solids would have more than 100,000 parts");
    }
    Solids sums;
    for (const Summand& p : *first) {
      for (const Summand& q : *second) sums.push_back(sum(p, q));
    }
    return evaluator_.builder().unite(sums);
  }

  static std::optional<std::vector<Summand>> convex_summands(const Summand& summand) {
    if (summand.balls) return std::vector<Summand>{summand};
    const auto parts = polyhedral_parts(summand.leaf);
    if (!parts) return std::nullopt;
    std::vector<Summand> summands;
    for (const ConvexCell& part : *parts) {
      const UnionLeaf leaf = leaf_of(part);
      summands.push_back({leaf, spanning_balls(leaf)});
    }
    return summands;
  }

  // Of extrusions along one axis.
  std::optional<Solid> sum_along(const UnionLeaf& a, const UnionLeaf& b) {
    const auto first = extrusion_of(a), second = extrusion_of(b);
    const auto to_frame = a.map.inverse();
    if (!first || !second || !to_frame) return std::nullopt;
    // Where their origins lie adds up outside of the frame.
    const Affine3 turn = with_translation(*to_frame * b.map, {});
    const auto aligned = aligned_extrusion(*second, turn);
    if (!aligned) return std::nullopt;
    const Result<Outline> sum = minkowski_sum(resolve(Shape::of(first->outline)), resolve(Shape::of(aligned->outline)));
    if (!sum) fail(at_, "minkowski(): " + sum.error().message);
    return extruded(evaluator_, {*sum, first->low + aligned->low, first->high + aligned->high},
                    with_translation(a.map, a.map.translation() + b.map.translation()), at_);
  }

  // A ball rolls around a solid of revolution as a circle around its profile.
  std::optional<Solid> sum_with_sphere(const UnionLeaf& round, const UnionLeaf& sphere) {
    const auto profile = full_profile(round);
    const auto scale = even_scale(round.map), sphere_scale = even_scale(sphere.map);
    if (!profile || !scale || !sphere_scale || sphere.kind != "sphere") return std::nullopt;
    const double radius = *sphere_scale * std::get<double>(sphere.values[0]) / *scale;
    return revolved(evaluator_, offset(resolve(*profile), radius, OffsetJoin::round),
                    with_translation(round.map, round.map.translation() + sphere.map.translation()), at_);
  }

  // A ball rolls around an extrusion that may be stretched along its axis, as linear_extrude() does.
  std::optional<Solid> rounded(const UnionLeaf& leaf, const UnionLeaf& sphere) {
    auto extrusion = extrusion_of(leaf);
    const auto sphere_scale = even_scale(sphere.map);
    if (!extrusion || !sphere_scale || sphere.kind != "sphere") return std::nullopt;
    const double stretch = length(leaf.map.column(2)) / length(leaf.map.column(0));
    const Affine3 frame = leaf.map * Affine3::scale({1, 1, 1 / stretch});
    const auto scale = even_scale(frame);
    if (!scale) return std::nullopt;
    extrusion->low *= stretch;
    extrusion->high *= stretch;
    const Solid solid =
        rounded_extrusion(evaluator_, *extrusion, *sphere_scale * std::get<double>(sphere.values[0]) / *scale, at_);
    const Affine3 map = with_translation(frame, frame.translation() + sphere.map.translation());
    return map == Affine3{} ? solid : evaluator_.builder().wrap(Transform{map}, {solid});
  }

  ModuleEvaluator& evaluator_;
  Place at_;
};

// Hulls of balls may be added up before they are built.
std::optional<Solid> sum_of_ball_hulls(ModuleEvaluator& evaluator, const std::vector<std::vector<Summand>>& operands,
                                       Place at) {
  std::vector<std::vector<Ball>> parts{{{{0, 0, 0}, 0}}};
  for (const std::vector<Summand>& operand : operands) {
    std::vector<std::vector<Ball>> next;
    for (const std::vector<Ball>& part : parts) {
      for (const Summand& summand : operand) {
        if (!summand.is_exact()) return std::nullopt;
        next.push_back(sums(part, summand.balls->balls));
      }
    }
    if (next.size() > most_pairs) fail(at, "minkowski() of these solids would have more than 100,000 parts");
    parts = std::move(next);
  }
  Solids solids;
  for (std::vector<Ball>& part : parts) solids.push_back(ball_hull(evaluator, std::move(part), at));
  return evaluator.builder().unite(solids);
}

}  // namespace

Solid minkowski_of_solids(ModuleEvaluator& evaluator, const Solids& solids, Place at) {
  std::vector<std::vector<Summand>> operands;
  for (const Solid& solid : solids) operands.push_back(summands_of(evaluator, solid, at));
  if (auto sum = sum_of_ball_hulls(evaluator, operands, at)) return *sum;
  Solid sum = solids.front();
  for (std::size_t i = 1; i < solids.size(); ++i) {
    const std::vector<Summand> summands = i == 1 ? operands[0] : summands_of(evaluator, sum, at);
    if (summands.size() * operands[i].size() > most_pairs) {
      fail(at, "minkowski() of these solids would have more than 100,000 parts");
    }
    Solids parts;
    for (const Summand& a : summands) {
      for (const Summand& b : operands[i]) parts.push_back(PairSum(evaluator, at).sum(a, b));
    }
    sum = evaluator.builder().unite(parts);
  }
  return sum;
}

}  // namespace tenon::lang
