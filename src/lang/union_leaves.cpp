#include "lang/union_leaves.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "lang/polyhedral_parts.h"
#include "plane/shape.h"

namespace tenon::lang {

namespace {

/// A Boolean expression over outlines, swept between two planes.
struct SweptShape {
  Shape shape;
  double low = 0, high = 0;
};

/// Takes what operations make of extrusions along one axis for an extrusion, where it is one.
class ShapeSweeper {
 public:
  explicit ShapeSweeper(const SceneGraph& graph) : graph_(graph) {}

  std::optional<UnionLeaf> sweep(SceneNodeId id, const Affine3& map) {
    const auto swept = swept_shape(id, map);
    if (!swept || !(swept->low < swept->high)) return std::nullopt;
    Outline outline = resolve(swept->shape);
    if (outline.loops.empty()) return std::nullopt;
    return UnionLeaf{"prism",
                     {std::move(outline), swept->high - swept->low, false, 1.0},
                     frame_ * Affine3::translate({0, 0, swept->low})};
  }

 private:
  std::optional<SweptShape> swept_shape(SceneNodeId id, const Affine3& map) {
    const SceneNode& node = graph_[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) return swept_leaf(leaf->primitive, map);
    const auto* transform = std::get_if<Transform>(&node.content);
    std::vector<SweptShape> parts;
    for (const SceneNodeId child : node.children) {
      auto part = swept_shape(child, transform ? map * transform->parent_from_child : map);
      if (!part) return std::nullopt;
      parts.push_back(std::move(*part));
    }
    const auto* operation = std::get_if<SetOperation>(&node.content);
    return operation ? combined(*operation, std::move(parts)) : combined(SetOperation::union_, std::move(parts));
  }

  // The first one sets the frame.
  std::optional<SweptShape> swept_leaf(PrimitiveId id, const Affine3& map) {
    const UnionLeaf leaf{graph_.primitives.kind(id).name, graph_.primitives.values(id), map};
    const auto extrusion = extrusion_of(leaf);
    if (!to_frame_) {
      frame_ = map;
      to_frame_ = map.inverse();
    }
    if (!extrusion || !to_frame_) return std::nullopt;
    const auto aligned = aligned_extrusion(*extrusion, *to_frame_ * map);
    if (!aligned) return std::nullopt;
    return SweptShape{Shape::of(aligned->outline), aligned->low, aligned->high};
  }

  static std::optional<SweptShape> combined(SetOperation operation, std::vector<SweptShape> parts) {
    SweptShape result{{}, parts.front().low, parts.front().high};
    // Of heights that were computed in two ways.
    const double near = 0x1p-40 * (std::fabs(result.low) + std::fabs(result.high));
    for (std::size_t i = 0; i < parts.size(); ++i) {
      SweptShape& part = parts[i];
      if (operation == SetOperation::intersection) {
        result.low = std::max(result.low, part.low);
        result.high = std::min(result.high, part.high);
      } else if (i > 0 && operation == SetOperation::difference) {
        // What passes by takes nothing, and what goes through takes all between the planes.
        if (part.high <= result.low + near || part.low >= result.high - near) continue;
        if (part.low > result.low + near || part.high < result.high - near) return std::nullopt;
      } else if (std::fabs(part.low - result.low) > near || std::fabs(part.high - result.high) > near) {
        return std::nullopt;
      }
      result.shape.parts.push_back(std::move(part.shape));
    }
    if (operation == SetOperation::complement) return std::nullopt;
    result.shape.operation = operation == SetOperation::union_         ? Shape::Operation::unite
                             : operation == SetOperation::intersection ? Shape::Operation::intersect
                                                                       : Shape::Operation::subtract;
    return result;
  }

  const SceneGraph& graph_;
  Affine3 frame_;
  std::optional<Affine3> to_frame_;
};

class LeafCollector {
 public:
  LeafCollector(ModuleEvaluator& evaluator, Place at) : evaluator_(evaluator), at_(at) {}

  // False where something else than a union is met, an extrusion, or what has flat faces alone.
  bool collect(SceneNodeId id, const Affine3& map) {
    evaluator_.expressions().check_depth(at_);
    const SceneGraph& graph = evaluator_.builder().model().graph;
    const SceneNode& node = graph[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      leaves.push_back({graph.primitives.kind(leaf->primitive).name, graph.primitives.values(leaf->primitive), map});
      return true;
    }
    const auto* operation = std::get_if<SetOperation>(&node.content);
    if (operation && *operation != SetOperation::union_) {
      if (auto extrusion = ShapeSweeper(graph).sweep(id, map)) {
        leaves.push_back(std::move(*extrusion));
        return true;
      }
      const auto parts = polyhedral_parts(graph, id, map);
      if (parts) std::transform(parts->begin(), parts->end(), std::back_inserter(leaves), leaf_of);
      return parts.has_value();
    }
    const auto* transform = std::get_if<Transform>(&node.content);
    const Affine3 inner = transform ? map * transform->parent_from_child : map;
    return std::all_of(node.children.begin(), node.children.end(),
                       [&](SceneNodeId child) { return collect(child, inner); });
  }

  std::vector<UnionLeaf> leaves;

 private:
  ModuleEvaluator& evaluator_;
  Place at_;
};

}  // namespace

std::optional<std::vector<UnionLeaf>> union_leaves(ModuleEvaluator& evaluator, const Solid& solid, Place at) {
  LeafCollector collector(evaluator, at);
  if (solid.is_nothing()) return collector.leaves;
  if (solid.is_everything() || !collector.collect(solid.node, {})) return std::nullopt;
  return std::move(collector.leaves);
}

}  // namespace tenon::lang
