#include "lang/projection.h"

#include <algorithm>

#include "csg/csg_tree.h"
#include "lang/flat_outline.h"
#include "lang/leaf_slice.h"
#include "lang/polyhedron_facets.h"
#include "lang/union_leaves.h"
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

std::optional<Shape> shadow_of_leaf(const UnionLeaf& leaf) {
  if (const auto scale = even_scale(leaf.map); scale && leaf.kind == "sphere") {
    const Vec3 c = leaf.map.translation();
    return Shape::of({{full_circle({{c.x, c.y}, *scale * std::get<double>(leaf.values[0])}, 1)}});
  }
  const auto extrusion = extrusion_of(leaf);
  if (extrusion) {
    if (const auto aligned = aligned_extrusion(*extrusion, leaf.map)) return Shape::of(aligned->outline);
  }
  if (const auto facets = polyhedron_facets(leaf)) {
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
