#include "lang/flat_shapes.h"

namespace tenon::lang {

namespace {

/// Rebuilds a flat shape with leaves that taper.
class Taper {
 public:
  Taper(ModuleEvaluator& evaluator, double scale, Place at) : evaluator_(evaluator), scale_(scale), at_(at) {}

  SceneNodeId rebuild(SceneNodeId id) {
    evaluator_.expressions().check_depth(at_);
    SceneGraph& graph = evaluator_.builder().model().graph;
    SceneNode node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) return rebuild(*leaf);
    if (auto* transform = std::get_if<Transform>(&node.content)) {
      // A shape that has been moved is moved in proportion: a shear.
      auto& m = transform->parent_from_child.m;
      for (std::size_t axis = 0; axis < 2; ++axis) m[axis][2] = (scale_ - 1) * m[axis][3];
    }
    for (SceneNodeId& child : node.children) child = rebuild(child);
    return graph.add(std::move(node));
  }

 private:
  SceneNodeId rebuild(const PrimitiveLeaf& leaf) {
    SceneGraph& graph = evaluator_.builder().model().graph;
    const std::string_view kind = graph.primitives.kind(leaf.primitive).name;
    const std::vector<FieldValue> values = graph.primitives.values(leaf.primitive);
    if (kind == "cylinder") {
      const double r = std::get<double>(values[1]);
      return add("cone", {1.0, r, r * scale_, false});
    }
    if (kind == "cube") {
      const Vec3 size = std::get<Vec3>(values[0]);
      return add("prism",
                 {Outline{{{{0, 0, 0}, {size.x, 0, 0}, {size.x, size.y, 0}, {0, size.y, 0}}}}, 1.0, false, scale_});
    }
    return add("prism", {values[0], 1.0, false, scale_});
  }

  SceneNodeId add(std::string_view kind, const std::vector<FieldValue>& values) {
    SceneGraph& graph = evaluator_.builder().model().graph;
    const Result<PrimitiveId> made = graph.primitives.add(*PrimitiveStore::find_kind(kind), values);
    if (!made) fail(at_, made.error().message);
    return graph.add({PrimitiveLeaf{*made}, {}});
  }

  ModuleEvaluator& evaluator_;
  double scale_;
  Place at_;
};

}  // namespace

Affine3 flattened(const Affine3& map) {
  Affine3 flat = map;
  flat.m[0][2] = flat.m[1][2] = 0;
  flat.m[2] = {0, 0, 1, 0};
  return flat;
}

Solid flat_children(ModuleCall& call) {
  ModuleEvaluator& evaluator = call.evaluator;
  const Solid shape = evaluator.builder().unite(evaluator.children(*call.instantiation.children, call.scope));
  if (shape.is_nothing() || shape.flat) return shape;
  const std::string name = evaluator.environment().text(call.instantiation.name);
  evaluator.environment().warn(call.at(),
                               name + "() takes shapes of the plane, and its children are solids; it makes nothing");
  return Solid::nothing();
}

Solid tapered(ModuleEvaluator& evaluator, const Solid& shape, double scale, Place at) {
  return Solid::of(Taper(evaluator, scale, at).rebuild(shape.node));
}

}  // namespace tenon::lang
