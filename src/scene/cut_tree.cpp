#include "scene/cut_tree.h"

#include <array>
#include <optional>

#include "primitive/dispatch.h"
#include "scene/solid_extent.h"

namespace tenon {

namespace {

/// Appends nodes at the end of a tree, so that children come before their parents.
class NodeWriter {
 public:
  explicit NodeWriter(CsgTree& tree) : tree_(tree) {}

  CsgNodeId operation(CsgOperation op, std::span<const CsgNodeId> operands) {
    const CsgNodeId id{tree_.nodes.size()};
    CsgNode node;
    node.operation = op;
    node.first_child = static_cast<std::uint32_t>(tree_.children.size());
    node.child_count = static_cast<std::uint32_t>(operands.size());
    for (const CsgNodeId operand : operands) {
      tree_.children.push_back(operand);
      tree_.nodes[operand.get()].parent = id;
    }
    tree_.nodes.push_back(node);
    return id;
  }

  CsgNodeId leaf(PrimitiveId primitive) {
    const Placement placement = *Placement::create(BoundedAffine3{}, {});
    const CsgNodeId id{tree_.nodes.size()};
    CsgNode node;
    node.operation = CsgOperation::leaf;
    node.leaf = LeafId{tree_.leaves.size()};
    tree_.nodes.push_back(node);
    tree_.leaves.push_back(
        {primitive, placement, world_bounds(tree_.primitives, primitive, BoundedAffine3{}), id, {}, {}});
    return id;
  }

 private:
  CsgTree& tree_;
};

double middle_along(SolidExtent& extent, const Vec3& normal) {
  if (extent.is_empty()) return 0;
  return 0.5 * (extent.support(normal) - extent.support(-normal));
}

// The half-spaces of each cut: what lies beyond its planes.
Result<std::vector<std::vector<PrimitiveId>>> add_half_spaces(CsgTree& tree, std::span<const SectionCut> cuts) {
  std::vector<std::vector<PrimitiveId>> all;
  std::optional<SolidExtent> extent;
  for (const SectionCut& cut : cuts) {
    all.emplace_back();
    for (const SectionPlane& plane : cut.planes) {
      if (!plane.d && !extent) extent.emplace(tree);
      const double d = plane.d ? *plane.d : middle_along(*extent, plane.normal);
      const std::array<FieldValue, 2> values{-plane.normal, -d};
      Result<PrimitiveId> added = tree.primitives.add(*PrimitiveStore::find_kind("halfspace"), values);
      if (!added) return Error{ErrorKind::input, "a cut of the section view: " + added.error().message, {}};
      all.back().push_back(*added);
    }
  }
  return all;
}

}  // namespace

Result<LeafId> cut_tree(CsgTree& tree, std::span<const SectionCut> cuts) {
  if (cuts.empty() || !tree.root) return LeafId{};
  const Result<std::vector<std::vector<PrimitiveId>>> half_spaces = add_half_spaces(tree, cuts);
  if (!half_spaces) return half_spaces.error();

  const LeafId first{tree.leaves.size()};
  NodeWriter writer(tree);
  std::vector<CsgNodeId> operands{tree.root};
  for (const std::vector<PrimitiveId>& cut : *half_spaces) {
    std::vector<CsgNodeId> beyond;
    for (const PrimitiveId half_space : cut) beyond.push_back(writer.leaf(half_space));
    operands.push_back(beyond.size() == 1 ? beyond.front() : writer.operation(CsgOperation::intersection, beyond));
  }
  tree.root = writer.operation(CsgOperation::difference, operands);
  return first;
}

}  // namespace tenon
