#include "lang/turned_shapes.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "csg/tolerance.h"
#include "lang/facets.h"
#include "lang/flat_outline.h"
#include "lang/turned_facets.h"
#include "plane/mapped_outline.h"
#include "plane/outline_figures.h"
#include "primitive/arc.h"
#include "primitive/outline_edges.h"

namespace tenon::lang {

namespace {

using Loop = std::vector<OutlineCorner>;

/// The circle that an outline is, if it is one: arcs that turn the same way around one centre, once.
/// @param same_place  how far apart two places are that count as one
std::optional<Circle> whole_circle(const Outline& outline, double same_place) {
  if (outline.loops.size() != 1) return std::nullopt;
  const Loop& loop = outline.loops.front();
  std::optional<Circle> circle;
  double quarter_turns = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
    if (a.bulge == 0 || (a.bulge > 0) != (loop.front().bulge > 0)) return std::nullopt;
    const auto [center, radius] = circle_of_arc({a.x, a.y}, {b.x, b.y}, a.bulge);
    if (!circle) circle = Circle{center, radius};
    const bool same = length(center - circle->center) <= same_place && std::fabs(radius - circle->radius) <= same_place;
    if (!same) return std::nullopt;
    quarter_turns += std::atan(std::fabs(a.bulge));
  }
  // Once around is a quarter turn of pi / 2, twice would be one of pi.
  return quarter_turns < 2 ? circle : std::nullopt;
}

/// Cuts off what lies left of the axis: each loop runs along the axis there instead.
class AxisCut {
 public:
  explicit AxisCut(double same_place) : same_place_(same_place) {}

  Loop cut(const Loop& loop) {
    kept_.clear();
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
      a.bulge == 0 ? cut_segment(snapped({a.x, a.y}), snapped({b.x, b.y})) : cut_arc({a.x, a.y}, {b.x, b.y}, a.bulge);
    }
    // Where the first edge was kept from its beginning, the last one has come back there.
    if (kept_.size() > 1 && kept_.back().x == kept_.front().x && kept_.back().y == kept_.front().y) kept_.pop_back();
    return std::move(kept_);
  }

 private:
  // What counts as a point of the axis is one.
  Vec2 snapped(const Vec2& p) const { return {std::fabs(p.x) <= same_place_ ? 0 : p.x, p.y}; }

  // A kept edge from a to b; its end is the beginning of the next one, or of a way along the axis.
  void keep(const Vec2& a, const Vec2& b, double bulge) {
    if (!kept_.empty() && kept_.back().x == a.x && kept_.back().y == a.y) kept_.pop_back();
    kept_.push_back({a.x, a.y, bulge});
    kept_.push_back({b.x, b.y, 0});
  }

  void cut_segment(const Vec2& a, const Vec2& b) {
    if (a.x < 0 && b.x < 0) return;
    const auto on_axis = [&] { return Vec2{0, a.y + (b.y - a.y) * (a.x / (a.x - b.x))}; };
    keep(a.x < 0 ? on_axis() : a, b.x < 0 ? on_axis() : b, 0);
  }

  void cut_arc(const Vec2& from, const Vec2& to, double bulge) {
    const auto [c, r] = circle_of_arc(from, to, bulge);
    // The arc's points on the axis, in its order: by the bulge of the part up to them, which grows along it.
    std::vector<std::pair<double, Vec2>> stops{{0, from}};
    const double square = (r - c.x) * (r + c.x);
    for (const double sign : {-1.0, 1.0}) {
      if (!(square > 0)) continue;
      const Vec2 p{0, c.y + sign * std::sqrt(square)};
      if (length(p - from) <= same_place_ || length(p - to) <= same_place_) continue;
      const double part = bulge_between(from, p, c, r, bulge);
      if (std::fabs(part) < std::fabs(bulge)) stops.emplace_back(std::fabs(part), p);
    }
    std::sort(stops.begin(), stops.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    stops.emplace_back(std::fabs(bulge), to);
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const Vec2 a = stops[i].second, b = stops[i + 1].second;
      const double part = stops.size() == 2 ? bulge : bulge_between(a, b, c, r, bulge);
      // The middle of the part tells on which side of the axis it lies.
      if (middle_of_arc(a, b, part).x > 0) keep(snapped(a), snapped(b), part);
    }
  }

  // tan(θ/4) = sin(θ/2) / (1 + cos(θ/2)), of the arc from a to b that turns as `like` does.
  static double bulge_between(const Vec2& a, const Vec2& b, const Vec2& c, double r, double like) {
    const Vec2 chord = b - a;
    const double l = length(chord), sine = l / (2 * r);
    const double cosine = cross(chord, c - a) / (l * r) * (like > 0 ? 1 : -1);
    return std::copysign(sine / (1 + cosine), like);
  }

  double same_place_;
  Loop kept_;
};

/// Rebuilds a flat shape as a solid of revolution, operation by operation.
class Turner {
 public:
  Turner(ModuleEvaluator& evaluator, Place at) : evaluator_(evaluator), at_(at) {}

  /// Has it turned in facets, but where it has arcs. @param angles  see turned_in_facets()
  void set_facets(std::vector<double> angles) { angles_ = std::move(angles); }

  /// @param map  of the shape into the plane of the axis
  Solid rebuild(SceneNodeId id, const Affine3& map, bool may_cross_axis) {
    evaluator_.expressions().check_depth(at_);
    SceneBuilder& builder = evaluator_.builder();
    const SceneNode node = builder.model().graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      return turn(outline_of_leaf(builder.model().graph.primitives, leaf->primitive), map, may_cross_axis);
    }
    const auto* operation = std::get_if<SetOperation>(&node.content);
    const auto* transform = std::get_if<Transform>(&node.content);
    const bool cuts = operation && *operation != SetOperation::union_;
    Solids parts;
    for (const SceneNodeId child : node.children) {
      parts.push_back(rebuild(child, transform ? map * transform->parent_from_child : map, may_cross_axis || cuts));
    }
    if (const auto* color = std::get_if<ColorAttribute>(&node.content)) return builder.wrap(*color, parts);
    if (const auto* material = std::get_if<MaterialAttribute>(&node.content)) return builder.wrap(*material, parts);
    if (!operation || *operation == SetOperation::union_) return builder.unite(parts);
    return *operation == SetOperation::intersection ? builder.intersect(parts) : builder.subtract(parts);
  }

  /// The largest |x| of the shape's parts, and whether any lies right of the axis.
  void survey(SceneNodeId id, const Affine3& map) {
    const SceneGraph& graph = evaluator_.builder().model().graph;
    const SceneNode& node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      for (const Vec3& sign : {Vec3{1, 1, 0}, Vec3{-1, 1, 0}}) {
        const OutlineEdges edges(outline_of_leaf(graph.primitives, leaf->primitive));
        const Vec2 n{sign.x * map.m[0][0], sign.x * map.m[0][1]};
        const double x = edges.support(n) + sign.x * map.m[0][3];
        (sign.x > 0 ? right_ : left_) = std::max(sign.x > 0 ? right_ : left_, x);
        const Vec2 up{sign.x * map.m[1][0], sign.x * map.m[1][1]};
        high_ = std::max(high_, edges.support(up) + sign.x * map.m[1][3]);
      }
      return;
    }
    const auto* transform = std::get_if<Transform>(&node.content);
    for (const SceneNodeId child : node.children) survey(child, transform ? map * transform->parent_from_child : map);
  }

  /// The largest |x| on each side of the axis, and |y|.
  double right() const { return right_; }
  double left() const { return left_; }
  double high() const { return high_; }
  double same_place() const { return Tolerance::relative * (std::max(right_, left_) + high_); }

 private:
  Solid turn(const Outline& outline, const Affine3& map, bool may_cross_axis) {
    if (!has_arcs(outline) || keeps_circles(map)) return turn(mapped(outline, map), may_cross_axis);
    if (map.m[0][1] != 0 || map.m[1][0] != 0) {
      fail(at_, "rotate_extrude() of an ellipse whose axes are turned is not supported yet; scale along x and y alone");
    }
    // What is stretched along the axis, or evenly across it, may be stretched after it is turned.
    const double across = std::fabs(map.m[0][0]), along = std::fabs(map.m[1][1]);
    const Affine3 inner = Affine3::scale({1 / across, 1 / along, 1}) * map;
    const Solid round = turn(mapped(outline, inner), may_cross_axis);
    return evaluator_.builder().wrap(Transform{Affine3::scale({across, across, along})}, {round});
  }

  Solid turn(Outline outline, bool may_cross_axis) {
    const OutlineEdges edges(outline);
    if (edges.lower().x < 0) {
      if (edges.lower().x < -same_place() && !may_cross_axis && !warned_) {
        evaluator_.environment().warn(at_,
                                      "rotate_extrude() has a shape on both sides of the axis; what lies left of it is "
                                      "cut off");
        warned_ = true;
      }
      AxisCut cut(same_place());
      for (Loop& loop : outline.loops) loop = cut.cut(loop);
      std::erase_if(outline.loops, [](const Loop& loop) { return loop.size() < 2; });
      if (outline.loops.empty()) return Solid::nothing();
    }
    SceneBuilder& builder = evaluator_.builder();
    if (!angles_.empty()) {
      if (!has_arcs(outline)) return turned_in_facets(evaluator_, outline, same_place(), angles_, at_);
      evaluator_.environment().warn(at_,
                                    "rotate_extrude() is round here, for the shape has arcs; give that few facets");
    }
    if (const auto circle = whole_circle(outline, same_place()); circle && circle->radius <= circle->center.x) {
      const Result<PrimitiveId> torus = builder.model().graph.primitives.add(
          *PrimitiveStore::find_kind("torus"), std::vector<FieldValue>{circle->center.x, circle->radius});
      if (torus && circle->center.y == 0) return builder.leaf(*torus);
      if (torus) return builder.wrap(Transform{Affine3::translate({0, 0, circle->center.y})}, {builder.leaf(*torus)});
    }
    const Result<PrimitiveId> made = builder.model().graph.primitives.add(*PrimitiveStore::find_kind("revolution"),
                                                                          std::vector<FieldValue>{outline});
    if (made) return builder.leaf(*made);
    evaluator_.environment().warn(at_, "rotate_extrude() leaves a part of its shape out: " + made.error().message);
    return Solid::nothing();
  }

  ModuleEvaluator& evaluator_;
  Place at_;
  std::vector<double> angles_;  // of facets, if there are
  double right_ = -HUGE_VAL, left_ = -HUGE_VAL, high_ = 0;
  bool warned_ = false;
};

// A piece of cake around z that reaches beyond everything within `radius` and `height`.
Solid wedge(ModuleEvaluator& evaluator, double degrees, double radius, double height) {
  Loop loop{{0, 0, 0}};
  const int steps = static_cast<int>(std::ceil(std::fabs(degrees) / 60));
  for (int i = 0; i <= steps; ++i) {
    const double angle = degrees * i / steps;
    // Steps of at most 60 degrees keep their chords outside of half the distance.
    loop.push_back({2 * radius * cos_degrees(angle), 2 * radius * sin_degrees(angle), 0});
  }
  SceneBuilder& builder = evaluator.builder();
  return builder.leaf(*builder.model().graph.primitives.add(
      *PrimitiveStore::find_kind("prism"), std::vector<FieldValue>{Outline{{loop}}, 4 * height, true, 1.0}));
}

}  // namespace

Solid turned(ModuleEvaluator& evaluator, const Solid& shape, double degrees, Place at) {
  Turner turner(evaluator, at);
  turner.survey(shape.node, {});
  const bool mirrored = turner.right() <= turner.same_place() && turner.left() > turner.same_place();
  const Affine3 map = mirrored ? Affine3::scale({-1, 1, 1}) : Affine3();
  if (const int facets = facet_count(evaluator, std::max(turner.right(), turner.left())); facets > 0) {
    const double part = std::min(std::fabs(degrees), 360.0);
    std::vector<double> angles = facet_angles(static_cast<int>(facets * part / 360), degrees);
    // The mirror image stands on the other side of the axis.
    if (mirrored && part == 360) std::ranges::for_each(angles, [](double& angle) { angle += 180; });
    turner.set_facets(std::move(angles));
  }
  const Solid round = turner.rebuild(shape.node, map, false);
  if (std::fabs(degrees) >= 360 || round.is_nothing()) return round;
  const double radius = std::max(turner.right(), turner.left()), height = turner.high() + radius;
  const Solid part = evaluator.builder().intersect({round, wedge(evaluator, degrees, radius, height)});
  return mirrored ? evaluator.builder().wrap(Transform{Affine3::rotate(180, {0, 0, 1})}, {part}) : part;
}

}  // namespace tenon::lang
