#include "lang/flat_outline.h"

#include "lang/primitive_arguments.h"
#include "plane/mapped_outline.h"
#include "plane/shape.h"

namespace tenon::lang {

namespace {

/// Makes the Boolean expression over outlines that a flat shape is.
class ShapeOfGraph {
 public:
  ShapeOfGraph(ModuleEvaluator& evaluator, Place at) : evaluator_(evaluator), at_(at) {}

  Shape shape(SceneNodeId id, const Affine3& map) {
    evaluator_.expressions().check_depth(at_);
    const SceneGraph& graph = evaluator_.builder().model().graph;
    const SceneNode& node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      return Shape::of(mapped(outline_of_leaf(graph.primitives, leaf->primitive), map));
    }
    const auto* transform = std::get_if<Transform>(&node.content);
    const Affine3 child_map = transform ? map * transform->parent_from_child : map;
    Shape result;
    for (const SceneNodeId child : node.children) result.parts.push_back(shape(child, child_map));
    if (const auto* operation = std::get_if<SetOperation>(&node.content)) result.operation = operation_of(*operation);
    return result;
  }

 private:
  Shape::Operation operation_of(SetOperation operation) const {
    switch (operation) {
      case SetOperation::union_:
        return Shape::Operation::unite;
      case SetOperation::intersection:
        return Shape::Operation::intersect;
      case SetOperation::difference:
        return Shape::Operation::subtract;
      case SetOperation::complement:
        break;
    }
    fail(at_,
         "a complement() has no outline; intersect it with a shape that is larger than what you need of it, "
         "within a difference() or an intersection()");
  }

  ModuleEvaluator& evaluator_;
  Place at_;
};

}  // namespace

Outline outline_of_leaf(const PrimitiveStore& store, PrimitiveId id) {
  const std::string_view kind = store.kind(id).name;
  const std::vector<FieldValue> values = store.values(id);
  if (kind == "cylinder") {
    const double r = std::get<double>(values[1]);
    return {{{{0, -r, 1}, {0, r, 1}}}};
  }
  if (kind == "cube") {
    const Vec3 size = std::get<Vec3>(values[0]);
    return {{{{0, 0, 0}, {size.x, 0, 0}, {size.x, size.y, 0}, {0, size.y, 0}}}};
  }
  return std::get<Outline>(values[0]);
}

Outline outline_of(ModuleEvaluator& evaluator, const Solid& shape, Place at) {
  if (shape.is_nothing()) return {};
  return resolve(ShapeOfGraph(evaluator, at).shape(shape.node, {}));
}

Solid flat_solid(ModuleEvaluator& evaluator, Outline outline, Place at) {
  if (outline.loops.empty()) return Solid::nothing();
  Solid shape = add_primitive(evaluator, at, "prism", {std::move(outline), 1.0, false, 1.0});
  shape.flat = !shape.is_nothing();
  return shape;
}

}  // namespace tenon::lang
