#include "accel/cells/prototype_cells.h"

#include <algorithm>
#include <cassert>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "csg/minimum_enclosure.h"

namespace tenon::cells {

namespace {

// Prototypes below a tree, each once, behind all in which it stands.
class OutsideIn {
 public:
  explicit OutsideIn(const CsgTree& tree) {
    visit(tree);
    std::reverse(order_.begin(), order_.end());
  }
  const std::vector<std::shared_ptr<const Prototype>>& order() const { return order_; }

 private:
  // Recursive, as deep as prototypes stand in one another: each is many times as large as what stands in it.
  void visit(const CsgTree& tree) {
    for (const std::shared_ptr<Prototype>& prototype : tree.prototypes) {
      if (!known_.insert(prototype.get()).second) continue;
      visit(prototype->tree());
      order_.push_back(prototype);
    }
  }

  std::vector<std::shared_ptr<const Prototype>> order_;
  std::unordered_set<const Prototype*> known_;
};

}  // namespace

std::vector<std::shared_ptr<const PrototypeCells>> build_prototype_cells(const CsgTree& tree, const CellScale& scale,
                                                                         const BuildSettings& settings) {
  std::unordered_map<const Prototype*, CellScale::Demands> demands;
  const auto ask = [&](const CsgTree& of, const CellScale& around) {
    for (const Leaf& leaf : of.leaves) {
      if (const Prototype* prototype = prototype_of(of, leaf)) demands[prototype].add(leaf.placement, around);
    }
  };
  std::unordered_map<const Prototype*, std::shared_ptr<PrototypeCells>> built;
  const auto those_of = [&](const CsgTree& of) {
    std::vector<std::shared_ptr<const PrototypeCells>> list;
    for (const auto& prototype : of.prototypes) list.push_back(built.at(prototype.get()));
    return list;
  };

  const OutsideIn prototypes(tree);
  ask(tree, scale);
  for (const std::shared_ptr<const Prototype>& prototype : prototypes.order()) {
    const CsgTree& part = prototype->tree();
    const CellScale part_scale = CellScale::of(part, demands[prototype.get()]);
    ask(part, part_scale);
    assert(!part.has_media);  // to the scene a part is one solid
    built[prototype.get()] = std::make_shared<PrototypeCells>(
        PrototypeCells{prototype, CellTree::build(part, node_enclosures(part)[part.root.get()], part_scale, settings)});
  }
  for (const auto& [prototype, cells] : built) cells->cells.prototypes = those_of(prototype->tree());
  return those_of(tree);
}

std::vector<const CellTree*> trees_within(const CellTree& cells) {
  std::vector<const CellTree*> trees{&cells};
  std::unordered_set<const CellTree*> known;
  for (std::size_t i = 0; i < trees.size(); ++i) {
    for (const auto& part : trees[i]->prototypes) {
      if (known.insert(&part->cells).second) trees.push_back(&part->cells);
    }
  }
  trees.erase(trees.begin());
  return trees;
}

}  // namespace tenon::cells
