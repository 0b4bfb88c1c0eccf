#include "lang/twisted_shapes.h"

#include <algorithm>
#include <unordered_map>

#include "lang/flat_outline.h"
#include "plane/mapped_outline.h"

namespace tenon::lang {

namespace {

/// Rebuilds a flat shape with leaves that twist around the one axis; so what moved them before moves their outlines.
/// Where lines cross walls that turn is costly to find, so operations on shapes of segments alone are carried out
/// first, which Clipper does within 2⁻⁴⁸ of their size (plane/shape.h). Arcs, which it knows by their chords, stay as
/// they are.
class Twister {
 public:
  Twister(ModuleEvaluator& evaluator, const Twist& twist, Place at) : evaluator_(evaluator), twist_(twist), at_(at) {}

  SceneNodeId rebuild(SceneNodeId id, const Affine3& map) {
    evaluator_.expressions().check_depth(at_);
    SceneGraph& graph = evaluator_.builder().model().graph;
    SceneNode node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      return prism(mapped(outline_of_leaf(graph.primitives, leaf->primitive), map));
    }
    if (node.children.size() > 1 && is_straight(id)) {
      return prism(mapped(outline_of(evaluator_, Solid::of(id), at_), map));
    }
    const auto* transform = std::get_if<Transform>(&node.content);
    const Affine3 inner = transform ? map * transform->parent_from_child : map;
    for (SceneNodeId& child : node.children) child = rebuild(child, inner);
    if (transform) node.content = SetOperation::union_;
    return graph.add(std::move(node));
  }

 private:
  // Whether a shape is made of segments, without attributes.
  bool is_straight(SceneNodeId id) {
    if (const auto known = straight_.find(id.get()); known != straight_.end()) return known->second;
    evaluator_.expressions().check_depth(at_);
    const SceneGraph& graph = evaluator_.builder().model().graph;
    const SceneNode& node = graph[id];
    bool result = false;
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      const Outline outline = outline_of_leaf(graph.primitives, leaf->primitive);
      const auto is_segment = [](const auto& corner) { return corner.bulge == 0; };
      result = std::all_of(outline.loops.begin(), outline.loops.end(),
                           [&](const auto& loop) { return std::all_of(loop.begin(), loop.end(), is_segment); });
    } else if (std::holds_alternative<Transform>(node.content) || is_operation_of_the_plane(node)) {
      result =
          std::all_of(node.children.begin(), node.children.end(), [this](SceneNodeId c) { return is_straight(c); });
    }
    straight_.emplace(id.get(), result);
    return result;
  }
  static bool is_operation_of_the_plane(const SceneNode& node) {
    const auto* operation = std::get_if<SetOperation>(&node.content);
    return operation != nullptr && *operation != SetOperation::complement;
  }

  SceneNodeId prism(Outline outline) {
    SceneGraph& graph = evaluator_.builder().model().graph;
    if (outline.loops.empty()) return graph.add({SetOperation::union_, {}});
    const Result<PrimitiveId> made = graph.primitives.add(
        *PrimitiveStore::find_kind("twisted_prism"),
        std::vector<FieldValue>{std::move(outline), 1.0, false, twist_.degrees, twist_.scale_x, twist_.scale_y});
    if (!made) fail(at_, made.error().message);
    return graph.add({PrimitiveLeaf{*made}, {}});
  }

  ModuleEvaluator& evaluator_;
  Twist twist_;
  Place at_;
  std::unordered_map<std::size_t, bool> straight_;
};

}  // namespace

Solid twisted(ModuleEvaluator& evaluator, const Solid& shape, const Twist& twist, Place at) {
  return Solid::of(Twister(evaluator, twist, at).rebuild(shape.node, {}));
}

}  // namespace tenon::lang
