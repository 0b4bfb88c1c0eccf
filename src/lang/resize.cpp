#include "lang/resize.h"

#include "primitive/dispatch.h"
#include "tenon/math/box3.h"

namespace tenon::lang {

namespace {

/// Finds the box of a part of the scene graph.
class BoundsFinder {
 public:
  BoundsFinder(ModuleEvaluator& evaluator, Place at) : evaluator_(evaluator), at_(at) {}

  Box3 bounds(SceneNodeId id, const Affine3& root_from_node) {
    evaluator_.expressions().check_depth(at_);
    const SceneNode& node = evaluator_.builder().model().graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) return bounds(leaf->primitive, root_from_node);
    if (const auto* transform = std::get_if<Transform>(&node.content)) {
      return hull_of_children(node, root_from_node * transform->parent_from_child);
    }
    const auto* operation = std::get_if<SetOperation>(&node.content);
    if (!operation || *operation == SetOperation::union_) return hull_of_children(node, root_from_node);
    if (*operation == SetOperation::complement) return Box3::everything();
    // What is cut away or shared may be smaller than the boxes tell.
    exact_ = false;
    Box3 box = bounds(node.children.front(), root_from_node);
    if (*operation == SetOperation::difference) return box;
    for (SceneNodeId child : node.children) box = intersection(box, bounds(child, root_from_node));
    return box;
  }

  bool exact() const { return exact_; }

 private:
  Box3 hull_of_children(const SceneNode& node, const Affine3& root_from_node) {
    Box3 box;
    for (SceneNodeId child : node.children) box = hull(box, bounds(child, root_from_node));
    return box;
  }

  Box3 bounds(PrimitiveId id, const Affine3& root_from_node) {
    const PrimitiveStore& store = evaluator_.builder().model().graph.primitives;
    Box3 box;
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 direction = root_from_node.row(axis);
      const double shift = root_from_node.translation()[axis];
      box.upper[axis] = support(store, id, direction) + shift;
      box.lower[axis] = shift - support(store, id, -direction);
    }
    return box;
  }

  ModuleEvaluator& evaluator_;
  Place at_;
  bool exact_ = true;
};

}  // namespace

Affine3 resizing(ModuleEvaluator& evaluator, const Solid& solid, const Vec3& new_size,
                 const std::array<bool, 3>& automatic, Place at) {
  BoundsFinder finder(evaluator, at);
  const Box3 box = solid.is_everything() ? Box3::everything() : finder.bounds(solid.node, {});
  if (box.is_empty()) return {};
  if (!box.is_bounded())
    fail(at, "resize() needs children of finite size; intersect them with a solid that bounds them");
  if (!finder.exact()) {
    evaluator.environment().warn(at,
                                 "resize() takes the size of a difference or an intersection from the boxes of its "
                                 "parts, which may be larger than what is left of them");
  }
  const Vec3 size = box.size();
  int largest = 0;
  for (int axis = 1; axis < 3; ++axis) {
    if (new_size[axis] > new_size[largest]) largest = axis;
  }
  const auto factor = [&](int axis) { return new_size[axis] > 0 && size[axis] > 0 ? new_size[axis] / size[axis] : 1; };
  Vec3 scale;
  for (int axis = 0; axis < 3; ++axis) {
    const bool follows = !(new_size[axis] > 0) && automatic[static_cast<std::size_t>(axis)];
    scale[axis] = factor(follows ? largest : axis);
  }
  return Affine3::scale(scale);
}

}  // namespace tenon::lang
