// The hierarchy of Goldsmith and Salmon (1987), as Bouatouch's course tells it ("Hierarchy: Goldsmith's et al.'s
// method"): objects are inserted one by one, each where it raises the tree's cost least.
//
// Where the course leaves something open:
//   * The cost of a tree is the sum, over its inner nodes, of the box's surface area times the number of children: the
//     boxes that a random ray which meets the scene has to be tested against (Goldsmith and Salmon's estimate).
//   * From a node the search follows one child, the one whose box grows least in area; of several, the first that does
//     not grow at all, else the smaller box. It ends early when the growth of the boxes passed costs more than
//     the best place found.
//   * The first object is the root; a second makes both children of a new node, as at any leaf.
//   * The order of insertion decides about the tree, and modelled order is often the worst. `order=shuffle` draws one
//     with `seed`, the same everywhere; `order=given` takes tree order.
//   * Objects are minimum enclosures. Nodes are opened nearest first, so that a ray may stop early.

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "accel/all.h"
#include "accel/nearest_first.h"
#include "accel/structure.h"
#include "csg/enclosures.h"
#include "kdtree/ray_box.h"

namespace tenon {

namespace {

// The tree while it grows.
class GoldsmithBuilder {
 public:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  struct Node {
    Box3 box;
    LeafId leaf;  // none for an inner node
    std::uint32_t parent = none;
    std::uint32_t first_child = none;
    std::uint32_t next_sibling = none;
    std::uint32_t child_count = 0;
  };

  void insert(const EnclosedLeaf& object) {
    Node node;
    node.box = object.box;
    node.leaf = object.leaf;
    nodes_.push_back(node);
    const auto added = static_cast<std::uint32_t>(nodes_.size() - 1);
    if (root_ == none) {
      root_ = added;
      return;
    }
    const std::uint32_t place = find_place(object.box);
    if (nodes_[place].leaf) {
      adopt(pair_up(place), added);
    } else {
      adopt(place, added);
    }
  }

  const std::vector<Node>& nodes() const { return nodes_; }
  std::uint32_t root() const { return root_; }

 private:
  // The node under which the object raises the cost least: as a child of an inner node, or beside a leaf.
  std::uint32_t find_place(const Box3& box) const {
    double best_cost = std::numeric_limits<double>::infinity();
    std::uint32_t best = root_;
    double inherited = 0;  // what the growth of the nodes passed costs
    for (std::uint32_t i = root_; inherited < best_cost;) {
      const Node& node = nodes_[i];
      const double grown_area = hull(node.box, box).surface_area();
      const double growth = node.child_count * (grown_area - node.box.surface_area());
      const double cost = inherited + (node.leaf ? 2 * grown_area : grown_area + growth);
      if (cost < best_cost) {
        best_cost = cost;
        best = i;
      }
      if (node.leaf) break;
      inherited += growth;
      i = child_that_grows_least(node, box);
    }
    return best;
  }

  std::uint32_t child_that_grows_least(const Node& node, const Box3& box) const {
    std::uint32_t best = node.first_child;
    double best_growth = std::numeric_limits<double>::infinity(), best_area = best_growth;
    for (std::uint32_t c = node.first_child; c != none; c = nodes_[c].next_sibling) {
      const double area = nodes_[c].box.surface_area();
      const double growth = hull(nodes_[c].box, box).surface_area() - area;
      if (growth > best_growth || (growth == best_growth && area >= best_area)) continue;
      best = c;
      best_growth = growth;
      best_area = area;
      if (growth == 0) break;
    }
    return best;
  }

  // Puts a new inner node in the place of a leaf, with the leaf as its child.
  std::uint32_t pair_up(std::uint32_t leaf) {
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    Node node = nodes_[leaf];
    node.leaf = LeafId{};
    node.first_child = leaf;
    node.child_count = 1;
    nodes_.push_back(node);
    nodes_[leaf].parent = id;
    nodes_[leaf].next_sibling = none;
    if (node.parent == none) {
      root_ = id;
      return id;
    }
    std::uint32_t* link = &nodes_[node.parent].first_child;
    while (*link != leaf) link = &nodes_[*link].next_sibling;
    *link = id;
    return id;
  }

  void adopt(std::uint32_t parent, std::uint32_t child) {
    nodes_[child].parent = parent;
    nodes_[child].next_sibling = nodes_[parent].first_child;
    nodes_[parent].first_child = child;
    ++nodes_[parent].child_count;
    // Bottom-up: the boxes on the way to the root grow, as long as they have to.
    const Box3 box = nodes_[child].box;
    for (std::uint32_t i = parent; i != none && !nodes_[i].box.contains(box); i = nodes_[i].parent) {
      nodes_[i].box = hull(nodes_[i].box, box);
    }
  }

  std::vector<Node> nodes_;
  std::uint32_t root_ = none;
};

class GoldsmithBvh {
 public:
  struct Scratch {
    EntryQueue queue;
  };

  explicit GoldsmithBvh(const std::vector<EnclosedLeaf>& objects) {
    GoldsmithBuilder builder;
    for (const EnclosedLeaf& object : objects) builder.insert(object);
    if (!objects.empty()) lay_out(builder);
  }

  void traverse(Walk& walk, Scratch& scratch) const {
    if (nodes_.empty()) return;
    const BoxRay ray(walk.ray());
    EntryQueue& queue = scratch.queue;
    queue.clear();
    const auto push = [&](std::uint32_t i) {
      const BoxSpan span = clip(ray, nodes_[i].box);
      if (!span.empty()) queue.push(span.t_in, i);
    };
    push(0);
    nearest_first(walk, queue, [&](std::uint32_t i) {
      const Node& node = nodes_[i];
      if (node.leaf) walk.reveal(node.leaf);
      for (std::uint32_t c = 0; c < node.child_count; ++c) push(node.first_child + c);
    });
  }

  std::size_t memory_bytes() const { return nodes_.size() * sizeof(Node); }
  std::size_t boxes() const { return nodes_.size(); }
  int depth() const { return depth_; }

 private:
  struct Node {
    Box3 box;
    LeafId leaf;  // none for an inner node
    std::uint32_t first_child = 0;
    std::uint32_t child_count = 0;
  };

  // Breadth first, so that siblings lie side by side.
  void lay_out(const GoldsmithBuilder& builder) {
    struct Visit {
      std::uint32_t node;
      int level;
    };
    std::vector<Visit> visits{{builder.root(), 1}};
    visits.reserve(builder.nodes().size());
    for (std::size_t i = 0; i < visits.size(); ++i) {
      const Visit visit = visits[i];
      const GoldsmithBuilder::Node& from = builder.nodes()[visit.node];
      nodes_.push_back({from.box, from.leaf, static_cast<std::uint32_t>(visits.size()), from.child_count});
      depth_ = std::max(depth_, visit.level);
      for (std::uint32_t c = from.first_child; c != GoldsmithBuilder::none; c = builder.nodes()[c].next_sibling) {
        visits.push_back({c, visit.level + 1});
      }
    }
  }

  std::vector<Node> nodes_;
  int depth_ = 0;
};

// The same order on every machine: the standard's distributions are not.
void shuffle(std::vector<EnclosedLeaf>& leaves, std::uint64_t seed) {
  std::mt19937_64 draw(seed);
  for (std::size_t i = leaves.size(); i > 1; --i) std::swap(leaves[i - 1], leaves[draw() % i]);
}

}  // namespace

Result<std::unique_ptr<Accelerator>> build_goldsmith_bvh(const BuildInput& input, AcceleratorOptions& options) {
  const bool given = options.take_word("order", {"shuffle", "given"}) == 1;
  const int seed = options.take_integer("seed", 1, 0, 1 << 30);
  if (Status status = options.finish(); !status) return status.error();
  std::vector<EnclosedLeaf> objects = enclosed_leaves(input.tree);
  if (!given) shuffle(objects, static_cast<std::uint64_t>(seed));
  return std::unique_ptr<Accelerator>(
      std::make_unique<StructureAccelerator<GoldsmithBvh>>(input.tree, GoldsmithBvh(objects)));
}

}  // namespace tenon
