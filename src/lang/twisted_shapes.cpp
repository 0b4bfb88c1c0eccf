#include "lang/twisted_shapes.h"

#include "lang/flat_outline.h"
#include "plane/mapped_outline.h"

namespace tenon::lang {

namespace {

/// Rebuilds a flat shape with leaves that twist around the one axis; so what moved them before moves their outlines.
class Twister {
 public:
  Twister(ModuleEvaluator& evaluator, const Twist& twist, Place at) : evaluator_(evaluator), twist_(twist), at_(at) {}

  SceneNodeId rebuild(SceneNodeId id, const Affine3& map) {
    evaluator_.expressions().check_depth(at_);
    SceneGraph& graph = evaluator_.builder().model().graph;
    SceneNode node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) return twist(leaf->primitive, map);
    const auto* transform = std::get_if<Transform>(&node.content);
    const Affine3 inner = transform ? map * transform->parent_from_child : map;
    for (SceneNodeId& child : node.children) child = rebuild(child, inner);
    if (transform) node.content = SetOperation::union_;
    return graph.add(std::move(node));
  }

 private:
  SceneNodeId twist(PrimitiveId primitive, const Affine3& map) {
    SceneGraph& graph = evaluator_.builder().model().graph;
    Outline outline = mapped(outline_of_leaf(graph.primitives, primitive), map);
    const Result<PrimitiveId> made = graph.primitives.add(
        *PrimitiveStore::find_kind("twisted_prism"),
        std::vector<FieldValue>{std::move(outline), 1.0, false, twist_.degrees, twist_.scale_x, twist_.scale_y});
    if (!made) fail(at_, made.error().message);
    return graph.add({PrimitiveLeaf{*made}, {}});
  }

  ModuleEvaluator& evaluator_;
  Twist twist_;
  Place at_;
};

}  // namespace

Solid twisted(ModuleEvaluator& evaluator, const Solid& shape, const Twist& twist, Place at) {
  return Solid::of(Twister(evaluator, twist, at).rebuild(shape.node, {}));
}

}  // namespace tenon::lang
