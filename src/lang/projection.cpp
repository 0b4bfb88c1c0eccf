#include "lang/projection.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "csg/csg_tree.h"
#include "lang/convex_parts.h"
#include "lang/flat_outline.h"
#include "mesh/convex_hull.h"
#include "plane/arc_corners.h"
#include "plane/contour.h"
#include "plane/convex_outline.h"
#include "plane/mapped_outline.h"
#include "plane/shape.h"
#include "primitive/dispatch.h"
#include "tenon/accel/accelerator.h"
#include "tenon/scene/scene.h"

namespace tenon::lang {

namespace {

/// The triangles of a polyhedron where it stands, counterclockwise as seen from outside.
struct Facets {
  std::vector<Vec3> points;
  std::vector<TriangleMesh::Corners> triangles;
};

std::optional<Facets> facets_of(const UnionLeaf& leaf) {
  Facets facets;
  if (leaf.kind == "mesh") {
    const TriangleMesh& mesh = *std::get<SharedMesh>(leaf.values[0]);
    if (std::get<bool>(leaf.values[1])) return std::nullopt;
    facets.points = mesh.vertices;
    facets.triangles = mesh.triangles;
  } else if (leaf.kind == "cube" || leaf.kind == "convex_polyhedron") {
    const auto balls = spanning_balls({leaf.kind, leaf.values, {}});
    std::vector<Vec3> points;
    for (const Ball& ball : balls->balls) points.push_back(ball.center);
    const ConvexHull hull = convex_hull(points);
    Vec3 middle;
    for (const Vec3& p : hull.points) middle += p / static_cast<double>(hull.points.size());
    facets.points = hull.points;
    for (const auto& face : hull.faces) {
      for (std::size_t i = 2; i < face.size(); ++i) {
        TriangleMesh::Corners c{static_cast<std::uint32_t>(face[0]), static_cast<std::uint32_t>(face[i - 1]),
                                static_cast<std::uint32_t>(face[i])};
        const Vec3 &p = hull.points[c[0]], &q = hull.points[c[1]], &r = hull.points[c[2]];
        if (dot(cross(q - p, r - p), p - middle) < 0) std::swap(c[1], c[2]);
        facets.triangles.push_back(c);
      }
    }
  } else {
    return std::nullopt;
  }
  for (Vec3& p : facets.points) p = leaf.map.point(p);
  if (leaf.map.determinant() < 0) {
    for (auto& corners : facets.triangles) std::swap(corners[1], corners[2]);
  }
  return facets;
}

/// The loops in which a polyhedron crosses the plane z = 0. A corner in the plane counts as below it, so that each
/// triangle crosses in two edges or in none, and loops close.
class Slice {
 public:
  explicit Slice(const Facets& facets) : points_(facets.points) {
    for (const auto& corners : facets.triangles) {
      Edge enters{}, leaves{};
      bool crosses = false;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
        if (is_above(a) == is_above(b)) continue;
        crosses = true;
        (is_above(b) ? enters : leaves) = std::minmax(a, b);
      }
      // The inside lies to the left as one goes from where the triangle's rim leaves the upper side.
      if (crosses) next_[leaves].push_back(enters);
    }
  }

  Outline outline() {
    Outline outline;
    while (!next_.empty()) {
      auto& loop = outline.loops.emplace_back();
      const Edge first = next_.begin()->first;
      Edge at = first;
      do {
        const Vec2 p = crossing(at);
        loop.push_back({p.x, p.y, 0});
        const auto found = next_.find(at);
        if (found == next_.end()) break;
        at = found->second.back();
        found->second.pop_back();
        if (found->second.empty()) next_.erase(found);
      } while (at != first);
    }
    std::erase_if(outline.loops, [](const auto& loop) { return loop.size() < 3; });
    return outline;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  bool is_above(std::uint32_t i) const { return points_[i].z > 0; }

  Vec2 crossing(const Edge& edge) const {
    const Vec3 &a = points_[edge.first], &b = points_[edge.second];
    const double t = a.z / (a.z - b.z);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }

  const std::vector<Vec3>& points_;
  std::map<Edge, std::vector<Edge>> next_;
};

// The unit circle's image in which a sphere crosses the plane; no loops where it does not.
Outline slice_of_sphere(double r, const Affine3& map) {
  const auto inverse = map.inverse();
  if (!inverse) return {};
  // |origin + x u + y v|² <= r², completed to squares.
  const Vec3 u = inverse->column(0), v = inverse->column(1), origin = inverse->translation();
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  const double x = (uv * dot(v, origin) - vv * dot(u, origin)) / determinant;
  const double y = (uv * dot(u, origin) - uu * dot(v, origin)) / determinant;
  const Vec3 nearest = origin + x * u + y * v;
  const double square = (r - length(nearest)) * (r + length(nearest));
  if (!(square > 0)) return {};
  // With the root of the form in triangles, the ellipse is the unit circle's image.
  const double a = std::sqrt(uu), b = uv / a, c = std::sqrt(determinant) / a, radius = std::sqrt(square);
  const Affine3 of_circle{{{{radius / a, -radius * b / (a * c), 0, x}, {0, radius / c, 0, y}, {0, 0, 1, 0}}}};
  return mapped({{full_circle({{0, 0}, 1}, 1)}}, of_circle);
}

/// An outline swept along z while it turns clockwise, by degrees, and is scaled.
struct Sweep {
  Outline outline;
  double low = 0, high = 0;
  double twist = 0;
  Vec2 from{1, 1}, to{1, 1};
};

std::optional<Sweep> sweep_of(const UnionLeaf& leaf) {
  const auto number = [&](std::size_t i) { return std::get<double>(leaf.values[i]); };
  Sweep sweep;
  const auto set_height = [&](double h, std::size_t center) {
    sweep.low = std::get<bool>(leaf.values[center]) ? -h / 2 : 0;
    sweep.high = sweep.low + h;
  };
  if (leaf.kind == "prism" || leaf.kind == "twisted_prism") {
    sweep.outline = std::get<Outline>(leaf.values[0]);
    set_height(number(1), 2);
    const bool turns = leaf.kind == "twisted_prism";
    sweep.twist = turns ? number(3) : 0;
    sweep.to = turns ? Vec2{number(4), number(5)} : Vec2{number(3), number(3)};
    return sweep;
  }
  if (leaf.kind != "cone") return std::nullopt;
  sweep.outline.loops = {full_circle({{0, 0}, 1}, 1)};
  set_height(number(0), 3);
  sweep.from = {number(1), number(1)};
  sweep.to = {number(2), number(2)};
  return sweep;
}

// One whose axis stays along z. As for straight ones, what lies lower counts of both ends.
std::optional<Shape> slice_of_sweep(const Sweep& sweep, const Affine3& map) {
  const auto inverse = map.inverse();
  if (!inverse || !keeps_z_axis(map)) return std::nullopt;
  const double share = (inverse->translation().z - sweep.low) / (sweep.high - sweep.low);
  const bool meets = map.m[2][2] > 0 ? share >= 0 && share < 1 : share > 0 && share <= 1;
  const Vec2 scale = sweep.from + share * (sweep.to - sweep.from);
  if (!meets || scale.x == 0 || scale.y == 0) return Shape{};
  const double c = cos_degrees(-sweep.twist * share), s = sin_degrees(-sweep.twist * share);
  const Affine3 here{{{{scale.x * c, -scale.x * s, 0, 0}, {scale.y * s, scale.y * c, 0, 0}, {0, 0, 1, 0}}}};
  return Shape::of(mapped(sweep.outline, map * here));
}

std::optional<Shape> slice_of_leaf(const UnionLeaf& leaf) {
  if (leaf.kind == "sphere") return Shape::of(slice_of_sphere(std::get<double>(leaf.values[0]), leaf.map));
  if (const auto extrusion = extrusion_of(leaf)) {
    if (const auto aligned = aligned_extrusion(*extrusion, leaf.map)) {
      const bool meets = aligned->low <= 0 && aligned->high > 0;
      return meets ? Shape::of(aligned->outline) : Shape{};
    }
  }
  if (const auto sweep = sweep_of(leaf)) {
    if (auto slice = slice_of_sweep(*sweep, leaf.map)) return slice;
  }
  const auto facets = facets_of(leaf);
  if (!facets) return std::nullopt;
  return Shape::of(resolve_winding(Slice(*facets).outline()));
}

std::optional<Shape> shadow_of_leaf(const UnionLeaf& leaf) {
  if (const auto scale = even_scale(leaf.map); scale && leaf.kind == "sphere") {
    const Vec3 c = leaf.map.translation();
    return Shape::of({{full_circle({{c.x, c.y}, *scale * std::get<double>(leaf.values[0])}, 1)}});
  }
  const auto extrusion = extrusion_of(leaf);
  if (extrusion) {
    if (const auto aligned = aligned_extrusion(*extrusion, leaf.map)) return Shape::of(aligned->outline);
  }
  if (const auto facets = facets_of(leaf)) {
    Outline outline;
    for (const auto& corners : facets->triangles) {
      std::vector<OutlineCorner> loop;
      for (const std::uint32_t i : corners) loop.push_back({facets->points[i].x, facets->points[i].y, 0});
      // Those that face down wind the other way, and would cancel what they cover.
      const double turn =
          (loop[1].x - loop[0].x) * (loop[2].y - loop[0].y) - (loop[1].y - loop[0].y) * (loop[2].x - loop[0].x);
      if (turn < 0) std::swap(loop[1], loop[2]);
      if (turn != 0) outline.loops.push_back(std::move(loop));
    }
    return Shape::of(resolve_winding(outline));
  }
  // The shadow of what is convex between two ends is the hull of theirs.
  Outline ends;
  const auto add_end = [&](const Outline& outline, double z) {
    const Outline end = mapped(outline, leaf.map * Affine3::translate({0, 0, z}));
    ends.loops.insert(ends.loops.end(), end.loops.begin(), end.loops.end());
  };
  if (extrusion && is_convex(leaf)) {
    add_end(extrusion->outline, extrusion->low);
    add_end(extrusion->outline, extrusion->high);
  } else if (leaf.kind == "cone") {
    const double h = std::get<double>(leaf.values[0]), low = std::get<bool>(leaf.values[3]) ? -h / 2 : 0;
    for (const auto& [r, z] :
         {std::pair{std::get<double>(leaf.values[1]), low}, {std::get<double>(leaf.values[2]), low + h}}) {
      // A tip is a circle too small to be seen.
      add_end({{full_circle({{0, 0}, std::max(r, 0x1p-40 * h)}, 1)}}, z);
    }
  } else {
    return std::nullopt;
  }
  return Shape::of(convex_hull(ends));
}

/// The section of a solid, operation by operation.
class Section {
 public:
  Section(ModuleEvaluator& evaluator, Place at) : evaluator_(evaluator), at_(at) {}

  // Nothing where a primitive has no exact one.
  std::optional<Shape> shape(SceneNodeId id, const Affine3& map) {
    evaluator_.expressions().check_depth(at_);
    const SceneGraph& graph = evaluator_.builder().model().graph;
    const SceneNode& node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      return slice_of_leaf(
          {graph.primitives.kind(leaf->primitive).name, graph.primitives.values(leaf->primitive), map});
    }
    const auto* operation = std::get_if<SetOperation>(&node.content);
    const auto* transform = std::get_if<Transform>(&node.content);
    if (operation && *operation == SetOperation::complement) return std::nullopt;
    Shape result;
    if (operation && *operation == SetOperation::intersection) result.operation = Shape::Operation::intersect;
    if (operation && *operation == SetOperation::difference) result.operation = Shape::Operation::subtract;
    for (const SceneNodeId child : node.children) {
      auto part = shape(child, transform ? map * transform->parent_from_child : map);
      if (!part) return std::nullopt;
      result.parts.push_back(std::move(*part));
    }
    return result;
  }

 private:
  ModuleEvaluator& evaluator_;
  Place at_;
};

/// Asks a solid where it is.
class SolidProbe {
 public:
  SolidProbe(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
    Model model;
    model.graph = SceneGraph(evaluator.builder().model().graph);
    model.graph.root = solid.node;
    Diagnostics unheard;
    Result<Scene> scene = compile_scene(std::move(model), unheard);
    if (!scene) fail(at, "projection(): " + scene.error().message);
    scene_ = std::move(*scene);
    bounds_ = scene_figures(scene_).bounds;
    if (!(max_component(bounds_.size()) < 1e60)) fail(at, "projection() of a solid without end is not supported");
    auto built = build_accelerator("cells", *scene_.tree);
    accelerator_ = std::move(*built);
    context_ = accelerator_->make_context();
  }

  Outline contour(bool (SolidProbe::*holds)(const Vec2&)) {
    return tenon::contour([&](const Vec2& p) { return (this->*holds)(p); }, {bounds_.lower.x, bounds_.lower.y},
                          {bounds_.upper.x, bounds_.upper.y});
  }

  bool is_hit_from_above(const Vec2& p) {
    query_.ray = {{p.x, p.y, bounds_.upper.z + bounds_.size().z + 1}, {0, 0, -1}};
    return accelerator_->occluded(query_, *context_);
  }
  // A solid that begins in the plane is there; one that ends there is not.
  bool is_met_at_plane(const Vec2& p) {
    query_.ray = {{p.x, p.y, 0}, {0, 0, 1}};
    spans_.clear();
    accelerator_->all_spans(query_, spans_, *context_);
    return !spans_.empty() && spans_.front().t_in == 0;
  }

 private:
  Scene scene_;
  Box3 bounds_;
  std::unique_ptr<Accelerator> accelerator_;
  std::unique_ptr<TraceContext> context_;
  RayQuery query_;
  std::vector<SolidSpan> spans_;
};

// The outline that a solid has for want of an exact one.
Outline probed(ModuleEvaluator& evaluator, const Solid& solid, Place at, bool (SolidProbe::*holds)(const Vec2&)) {
  return SolidProbe(evaluator, solid, at).contour(holds);
}

}  // namespace

Solid cut_projection(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
  const auto shape = Section(evaluator, at).shape(solid.node, {});
  return flat_solid(evaluator, shape ? resolve(*shape) : probed(evaluator, solid, at, &SolidProbe::is_met_at_plane),
                    at);
}

Solid shadow_projection(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
  const auto leaves = union_leaves(evaluator, solid, at);
  Shape shadow;
  bool exact = leaves.has_value();
  for (std::size_t i = 0; exact && i < leaves->size(); ++i) {
    auto part = shadow_of_leaf((*leaves)[i]);
    exact = part.has_value();
    if (exact) shadow.parts.push_back(std::move(*part));
  }
  return flat_solid(evaluator, exact ? resolve(shadow) : probed(evaluator, solid, at, &SolidProbe::is_hit_from_above),
                    at);
}

}  // namespace tenon::lang
