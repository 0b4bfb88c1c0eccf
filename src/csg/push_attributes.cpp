#include "csg/push_attributes.h"

#include <algorithm>
#include <utility>

#include "primitive/dispatch.h"

namespace tenon {

namespace {

// What the way from the root to a node has collected.
struct Attributes {
  BoundedAffine3 world_from_local;
  MaterialId material;
  std::optional<Rgba> color;
  CutFaces cut_faces = CutFaces::tool;
};

// A node whose children are being visited.
struct Frame {
  const SceneNode* node;
  std::size_t next_child = 0;
  std::size_t first_operand = 0;  // into operands_: the CSG nodes its children have given so far
  bool changes_attributes = false;
};

class Pusher {
 public:
  Pusher(SceneGraph graph, Diagnostics& diagnostics) : graph_(std::move(graph)), diagnostics_(diagnostics) {}

  CsgTree run() {
    attributes_.emplace_back();
    if (graph_.root) enter(graph_[graph_.root]);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      if (frame.next_child < frame.node->children.size()) {
        enter(graph_[frame.node->children[frame.next_child++]]);
      } else {
        leave();
      }
    }
    if (!operands_.empty()) tree_.root = operands_.back();
    if (flattened_ > 0) {
      diagnostics_.warn(std::to_string(flattened_) +
                        " primitives are flattened by their transformations and make no solid; look for a zero scale");
    }
    if (subtracted_surfaces_ > 0) {
      diagnostics_.warn(std::to_string(subtracted_surfaces_) +
                        " surfaces are subtracted and left out; a surface has no inside that could be taken away");
    }
    double largest = 0;
    for (const Leaf& leaf : tree_.leaves) {
      if (leaf.bounds.is_bounded()) largest = std::max(largest, leaf.bounds.largest_coordinate());
    }
    tree_.tolerance = Tolerance::of_scene(largest);
    tree_.primitives = std::move(graph_.primitives);
    return std::move(tree_);
  }

 private:
  void enter(const SceneNode& node) {
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      add_leaf(leaf->primitive);
      return;
    }
    Frame frame{&node, 0, operands_.size(), false};
    if (!std::holds_alternative<SetOperation>(node.content)) {
      frame.changes_attributes = true;
      attributes_.push_back(with(attributes_.back(), node));
    }
    frames_.push_back(frame);
  }

  static Attributes with(Attributes attributes, const SceneNode& node) {
    if (const auto* transform = std::get_if<Transform>(&node.content)) {
      attributes.world_from_local =
          attributes.world_from_local * BoundedAffine3::elementary(transform->parent_from_child);
    } else if (const auto* color = std::get_if<ColorAttribute>(&node.content)) {
      if (!attributes.color) attributes.color = color->color;
    } else if (const auto* material = std::get_if<MaterialAttribute>(&node.content)) {
      attributes.material = material->material;
    } else if (const auto* cut_faces = std::get_if<CutFacesAttribute>(&node.content)) {
      attributes.cut_faces = cut_faces->show;
    }
    return attributes;
  }

  // All children are visited: their CSG nodes become the operands of this node's.
  void leave() {
    const Frame frame = frames_.back();
    frames_.pop_back();
    if (frame.changes_attributes) attributes_.pop_back();

    const auto* operation = std::get_if<SetOperation>(&frame.node->content);
    const CsgOperation op = operation == nullptr ? CsgOperation::union_ : csg_operation(*operation);
    const std::size_t count = operands_.size() - frame.first_operand;
    // An attribute, a union, an intersection or a difference of one operand is that operand.
    if (count == 1 && op != CsgOperation::complement) return;
    add_operation(op, frame.first_operand);
  }

  static CsgOperation csg_operation(SetOperation operation) {
    switch (operation) {
      case SetOperation::intersection:
        return CsgOperation::intersection;
      case SetOperation::difference:
        return CsgOperation::difference;
      case SetOperation::complement:
        return CsgOperation::complement;
      case SetOperation::union_:
        break;
    }
    return CsgOperation::union_;
  }

  void add_operation(CsgOperation op, std::size_t first_operand) {
    // A complement is that of the union of its children; an intersection or a difference of nothing is nothing.
    if (op == CsgOperation::complement && operands_.size() - first_operand != 1) {
      add_operation(CsgOperation::union_, first_operand);
      first_operand = operands_.size() - 1;
    }
    if (operands_.size() == first_operand) op = CsgOperation::union_;
    const CsgNodeId id{tree_.nodes.size()};
    CsgNode node;
    node.operation = op;
    node.first_child = static_cast<std::uint32_t>(tree_.children.size());
    node.child_count = static_cast<std::uint32_t>(operands_.size() - first_operand);
    for (std::size_t i = first_operand; i < operands_.size(); ++i) {
      tree_.children.push_back(operands_[i]);
      tree_.nodes[operands_[i].get()].parent = id;
    }
    operands_.resize(first_operand);
    operands_.push_back(id);
    tree_.nodes.push_back(node);
  }

  // How many complements stand above, a difference's second operand being one.
  std::size_t complements_above() const {
    return static_cast<std::size_t>(std::count_if(frames_.begin(), frames_.end(), [](const Frame& frame) {
      const auto* operation = std::get_if<SetOperation>(&frame.node->content);
      if (operation == nullptr) return false;
      // The child being visited is the one before next_child.
      const bool is_tool = *operation == SetOperation::difference && frame.next_child > 1;
      return is_tool || *operation == SetOperation::complement;
    }));
  }
  bool is_subtracted() const { return complements_above() % 2 == 1; }
  // What is taken out of a tool leaves its faces where the tool cuts, too.
  bool is_part_of_tool() const { return complements_above() > 0; }

  void add_leaf(PrimitiveId primitive) {
    const Attributes& attributes = attributes_.back();
    const PrimitiveStore& store = graph_.primitives;
    std::optional<Placement> placement = Placement::create(attributes.world_from_local, local_center(store, primitive));
    const CsgNodeId node_id{tree_.nodes.size()};
    CsgNode node;
    operands_.push_back(node_id);
    const bool subtracted_surface = is_surface(store, primitive) && is_subtracted();
    if (!placement || subtracted_surface) {
      ++(subtracted_surface ? subtracted_surfaces_ : flattened_);
      tree_.nodes.push_back(node);  // a union of nothing
      return;
    }
    node.operation = CsgOperation::leaf;
    node.leaf = LeafId{tree_.leaves.size()};
    tree_.nodes.push_back(node);
    Leaf leaf{primitive, *placement,          world_bounds(store, primitive, *placement),
              node_id,   attributes.material, attributes.color};
    leaf.shows_what_it_cut = attributes.cut_faces == CutFaces::base && is_part_of_tool();
    tree_.leaves.push_back(leaf);
  }

  static Vec3 local_center(const PrimitiveStore& store, PrimitiveId primitive) {
    Vec3 center;
    for (int axis = 0; axis < 3; ++axis) {
      Vec3 n;
      n[axis] = 1;
      const double mid = 0.5 * (support(store, primitive, n) - support(store, primitive, -n));
      if (std::isfinite(mid)) center[axis] = mid;
    }
    return center;
  }

  SceneGraph graph_;
  Diagnostics& diagnostics_;
  CsgTree tree_;
  std::vector<Frame> frames_;
  std::vector<Attributes> attributes_;
  std::vector<CsgNodeId> operands_;
  std::size_t flattened_ = 0;
  std::size_t subtracted_surfaces_ = 0;
};

}  // namespace

CsgTree push_attributes(SceneGraph graph, Diagnostics& diagnostics) {
  return Pusher(std::move(graph), diagnostics).run();
}

int CsgTree::depth() const {
  if (!root) return 0;
  std::vector<int> height(nodes.size(), 0);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    int below = 0;
    for (const CsgNodeId child : children_of(nodes[i])) below = std::max(below, height[child.get()]);
    height[i] = below + 1;
  }
  return height[root.get()];
}

}  // namespace tenon
