#include "exchange/pov_solid.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "csg/csg_tree.h"
#include "exchange/pov_primitive.h"

namespace tenon {

namespace {

// What the leaves below a node show.
enum class Coat : std::uint8_t {
  bare,   // nothing of their own: tools, which take the material of what they cut
  one,    // one material, but for bare ones
  mixed,  // several
};

struct NodeSummary {
  bool is_empty = false;  // no points at all; POV-Ray has no such object
  Coat coat = Coat::bare;
  MaterialId material;  // of Coat::one
};

struct Visit {
  CsgNodeId node;
  bool coated = false;   // an ancestor gives the material
  bool splices = false;  // a union in this place may be left to what stands around it
  bool is_open = false;  // its head is written, and wants an end
  std::size_t next = 0;  // child
};

class PovSolidPrinter {
 public:
  PovSolidPrinter(const Scene& scene, PovText& out) : scene_(scene), tree_(*scene.tree), out_(out) {}

  Status print() {
    if (!tree_.root) return success();
    mark_tools();
    if (Status status = summarize(); !status) return status;
    if (summary(tree_.root).is_empty) return success();
    return print_tree();
  }

 private:
  const NodeSummary& summary(CsgNodeId id) const { return summaries_[id.get()]; }

  // The nodes that are subtracted from something, from the root down: parents come after their children in the array.
  void mark_tools() {
    is_tool_.assign(tree_.nodes.size(), false);
    for (std::size_t i = tree_.nodes.size(); i-- > 0;) {
      const CsgNode& node = tree_.nodes[i];
      const auto children = tree_.children_of(node);
      for (std::size_t k = 0; k < children.size(); ++k) {
        const bool subtracted =
            node.operation == CsgOperation::complement || (node.operation == CsgOperation::difference && k > 0);
        is_tool_[children[k].get()] = is_tool_[i] || subtracted;
      }
    }
  }

  Status summarize() {
    summaries_.resize(tree_.nodes.size());
    for (std::size_t i = 0; i < tree_.nodes.size(); ++i) {
      const CsgNode& node = tree_.nodes[i];
      NodeSummary& s = summaries_[i];
      if (node.operation == CsgOperation::leaf) {
        const Leaf& leaf = tree_[node.leaf];
        const MaterialId material = leaf.shows_what_it_cut ? MaterialId{} : leaf.material;
        s.coat = material || !is_tool_[i] ? Coat::one : Coat::bare;
        s.material = material;
        continue;
      }
      const auto children = tree_.children_of(node);
      s.is_empty = is_empty(node.operation, children);
      if (node.operation == CsgOperation::complement && summary(children[0]).is_empty) {
        return Error{
            ErrorKind::input, "the complement of nothing fills all space, which a POV-Ray scene cannot say", {}};
      }
      for (const CsgNodeId child : children) {
        if (!summary(child).is_empty) add_coat(summary(child), s);
      }
    }
    return success();
  }

  bool is_empty(CsgOperation operation, std::span<const CsgNodeId> children) const {
    const auto empty = [this](CsgNodeId id) { return summary(id).is_empty; };
    switch (operation) {
      case CsgOperation::union_:
        return std::all_of(children.begin(), children.end(), empty);
      case CsgOperation::intersection:
        return std::any_of(children.begin(), children.end(), empty);
      case CsgOperation::difference:
        return empty(children[0]);
      case CsgOperation::complement:
      case CsgOperation::leaf:
        break;
    }
    return false;
  }

  static void add_coat(const NodeSummary& child, NodeSummary& sum) {
    if (child.coat == Coat::bare) return;
    if (sum.coat == Coat::bare) {
      sum.coat = child.coat;
      sum.material = child.material;
    } else if (child.coat == Coat::mixed || child.material != sum.material) {
      sum.coat = Coat::mixed;
    }
  }

  Status print_tree() {
    std::vector<Visit> path{open({tree_.root, false, !tree_.has_media})};
    while (!path.empty()) {
      Visit& visit = path.back();
      const CsgNode& node = tree_[visit.node];
      if (node.operation == CsgOperation::leaf) {
        if (!print_leaf(node.leaf, visit.coated)) return unknown_primitive(node.leaf);
        path.pop_back();
        continue;
      }
      const auto children = tree_.children_of(node);
      while (visit.next < children.size() && summary(children[visit.next]).is_empty) ++visit.next;
      if (visit.next < children.size()) {
        const Visit child = open(child_of(visit, children[visit.next]));
        ++visit.next;
        path.push_back(child);
      } else {
        if (visit.is_open) close(visit);
        path.pop_back();
      }
    }
    return success();
  }

  Visit child_of(const Visit& visit, CsgNodeId child) const {
    if (!visit.is_open) return {child, visit.coated, visit.splices};
    const CsgOperation operation = tree_[visit.node].operation;
    const bool is_tool = operation == CsgOperation::difference && visit.next > 0;
    const bool in_union = operation == CsgOperation::union_ || operation == CsgOperation::complement;
    return {child, visit.coated || summary(visit.node).coat == Coat::one, is_tool || in_union};
  }

  // Writes the head of an operation, unless it can do without: an operation on one operand is that operand, a union in
  // a union or among the tools of a difference adds nothing but time (POV-Ray traces 200 tools in two thirds of it
  // without), and members of the outermost union are objects of their own, which POV-Ray sorts into a hierarchy.
  Visit open(Visit visit) {
    const CsgNode& node = tree_[visit.node];
    if (node.operation == CsgOperation::leaf) return visit;
    const auto children = tree_.children_of(node);
    const auto operands =
        std::count_if(children.begin(), children.end(), [this](CsgNodeId c) { return !summary(c).is_empty; });
    const bool dissolves = node.operation == CsgOperation::union_ && visit.splices;
    visit.is_open = !dissolves && (operands > 1 || node.operation == CsgOperation::complement);
    if (visit.is_open) out_ << keyword(node.operation) << " {\n";
    return visit;
  }

  // A union of transparent solids has no walls inside: POV-Ray's merge. A complement is the inverse of a union.
  std::string_view keyword(CsgOperation operation) const {
    if (operation == CsgOperation::intersection) return "intersection";
    if (operation == CsgOperation::difference) return "difference";
    return tree_.has_media ? "merge" : "union";
  }

  void close(const Visit& visit) {
    const CsgNode& node = tree_[visit.node];
    const NodeSummary& s = summary(visit.node);
    if (node.operation == CsgOperation::complement) out_ << " inverse";
    if (!visit.coated && s.coat == Coat::one) print_material(s.material);
    const bool cuts = node.operation == CsgOperation::difference || node.operation == CsgOperation::intersection;
    if (cuts && s.coat == Coat::mixed) out_ << " cutaway_textures";
    out_ << " }\n";
  }

  bool print_leaf(LeafId id, bool coated) {
    const Leaf& leaf = tree_[id];
    if (!print_pov_primitive(tree_.primitives, leaf.primitive, out_)) return false;
    if (leaf.placement.world_from_local() != Affine3{}) out_ << " " << leaf.placement.world_from_local();
    const NodeSummary& s = summary(leaf.node);
    if (!coated && s.coat == Coat::one) print_material(s.material);
    out_ << " }\n";
    return true;
  }

  void print_material(MaterialId id) { out_ << " material { " << pov_material_name(id) << " }"; }

  Error unknown_primitive(LeafId id) const {
    return {ErrorKind::input,
            "POV-Ray has nothing for a " + std::string(primitive_name(scene_, id)) + "; leave it out of this scene",
            {}};
  }

  const Scene& scene_;
  const CsgTree& tree_;
  PovText& out_;
  std::vector<bool> is_tool_;
  std::vector<NodeSummary> summaries_;
};

}  // namespace

std::string pov_material_name(MaterialId id) {
  return id ? "Material_" + std::to_string(id.get()) : "Material_default";
}

Status print_pov_solid(const Scene& scene, PovText& out) {
  return PovSolidPrinter(scene, out).print();
}

}  // namespace tenon
