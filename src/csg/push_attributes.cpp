#include "csg/push_attributes.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "csg/prototype.h"
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

// What was left out on the way.
struct LeftOut {
  std::size_t flattened = 0;
  std::size_t subtracted_surfaces = 0;
};

std::string count(std::size_t n, const char* one, const char* many) {
  return std::to_string(n) + ' ' + (n == 1 ? one : many);
}

class Pusher {
 public:
  Pusher(const SceneGraph& graph, const InstancePlan& plan, LeftOut& left_out)
      : graph_(graph), plan_(plan), left_out_(left_out) {}

  /// @param outer  the attributes that the node inherits
  CsgTree run(SceneNodeId root, const Attributes& outer) {
    root_ = root;
    attributes_.push_back(outer);
    // Growing step by step would take twice the memory at the end.
    if (root == graph_.root) tree_.leaves.reserve(static_cast<std::size_t>(std::min(plan_.leaves, most_reserved)));
    if (root) enter(root);
    while (!frames_.empty()) {
      Frame& frame = frames_.back();
      if (frame.next_child < frame.node->children.size()) {
        enter(frame.node->children[frame.next_child++]);
      } else {
        leave();
      }
    }
    if (!operands_.empty()) tree_.root = operands_.back();
    double largest = 0;
    for (const Leaf& leaf : tree_.leaves) {
      if (leaf.bounds.is_bounded()) largest = std::max(largest, leaf.bounds.largest_coordinate());
    }
    tree_.tolerance = Tolerance::of_scene(largest);
    return std::move(tree_);
  }

 private:
  static constexpr double most_reserved = 1 << 24;

  void enter(SceneNodeId id) {
    const SceneNode& node = graph_[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      add_leaf(graph_.primitives, leaf->primitive, {});
      return;
    }
    if (id != root_ && plan_.stores(id) && add_instance(id)) return;
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

  // The attributes of an instance go to its leaf, and into the prototype where that has some of its own to combine.
  bool add_instance(SceneNodeId id) {
    const Attributes& attributes = attributes_.back();
    Attributes outer;
    outer.cut_faces = attributes.cut_faces;
    if (plan_.has_materials[id.get()]) {
      outer.material = attributes.material;
      outer.color = attributes.color;
      const bool is_transparent =
          (outer.material && plan_.is_transparent[outer.material.get()]) || (outer.color && outer.color->a < 1);
      if (is_transparent) return false;
    }
    const Rgba color = outer.color.value_or(Rgba{-1, 0, 0, 0});
    const Key key{id, outer.material, {color.r, color.g, color.b, color.a}, outer.cut_faces};
    const auto [known, is_new] = prototypes_.try_emplace(key);
    if (is_new) {
      if (auto prototype = Prototype::create(Pusher(graph_, plan_, left_out_).run(id, outer))) {
        known->second = {tree_.primitives.add_instance(prototype), PrototypeId{tree_.prototypes.size()}};
        tree_.prototypes.push_back(std::move(prototype));
      }
    }
    const auto [primitive, prototype] = known->second;
    if (!prototype) return false;
    add_leaf(tree_.primitives, primitive, prototype);
    return true;
  }

  void add_leaf(const PrimitiveStore& store, PrimitiveId primitive, PrototypeId prototype) {
    const Attributes& attributes = attributes_.back();
    std::optional<Placement> placement = Placement::create(attributes.world_from_local, local_center(store, primitive));
    const CsgNodeId node_id{tree_.nodes.size()};
    CsgNode node;
    operands_.push_back(node_id);
    const bool subtracted_surface = is_surface(store, primitive) && is_subtracted();
    if (!placement || subtracted_surface) {
      ++(subtracted_surface ? left_out_.subtracted_surfaces : left_out_.flattened);
      tree_.nodes.push_back(node);  // a union of nothing
      return;
    }
    node.operation = CsgOperation::leaf;
    node.leaf = LeafId{tree_.leaves.size()};
    tree_.nodes.push_back(node);
    Leaf leaf{prototype ? primitive : own_primitive(primitive),
              *placement,
              world_bounds(store, primitive, attributes.world_from_local),
              node_id,
              attributes.material,
              color_id(attributes.color)};
    leaf.shows_what_it_cut = attributes.cut_faces == CutFaces::base && is_part_of_tool();
    leaf.prototype = prototype;
    tree_.leaves.push_back(leaf);
  }

  // Neighbours in a scene tend to share their colour.
  ColorId color_id(const std::optional<Rgba>& color) {
    if (!color) return {};
    if (tree_.colors.empty() || tree_.colors.back() != *color) tree_.colors.push_back(*color);
    return ColorId{tree_.colors.size() - 1};
  }

  // The tree's copy of a primitive of the graph.
  PrimitiveId own_primitive(PrimitiveId of_graph) {
    const auto [known, is_new] = copies_.try_emplace(of_graph);
    if (is_new) known->second = tree_.primitives.add_copy(graph_.primitives, of_graph);
    return known->second;
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

  using Key = std::tuple<SceneNodeId, MaterialId, std::array<double, 4>, CutFaces>;
  struct Stored {
    PrimitiveId primitive;
    PrototypeId prototype;
  };

  const SceneGraph& graph_;
  const InstancePlan& plan_;
  LeftOut& left_out_;
  SceneNodeId root_;
  CsgTree tree_;
  std::map<Key, Stored> prototypes_;
  std::unordered_map<PrimitiveId, PrimitiveId> copies_;
  std::vector<Frame> frames_;
  std::vector<Attributes> attributes_;
  std::vector<CsgNodeId> operands_;
};

}  // namespace

CsgTree push_attributes(SceneGraph graph, Diagnostics& diagnostics, const InstancePlan& plan) {
  LeftOut left_out;
  CsgTree tree = Pusher(graph, plan, left_out).run(graph.root, {});
  if (left_out.flattened > 0) {
    diagnostics.warn(count(left_out.flattened, "primitive is flattened by its transformations and makes",
                           "primitives are flattened by their transformations and make") +
                     " no solid; look for a zero scale");
  }
  if (left_out.subtracted_surfaces > 0) {
    diagnostics.warn(count(left_out.subtracted_surfaces, "surface is", "surfaces are") +
                     " subtracted and left out; a surface has no inside that could be taken away");
  }
  return tree;
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
