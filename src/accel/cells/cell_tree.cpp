#include "accel/cells/cell_tree.h"

#include <cmath>
#include <limits>

namespace tenon::cells {

namespace {

// 64-bit tables of up to six leaves, one state after the other; the owner of every true state.
void tabulate(std::span<const Symbol> expression, Cell& cell) {
  Owner owner;
  bool first = true;
  for (std::uint32_t state = 0; state < (1U << cell.leaf_count); ++state) {
    const PointValue point = evaluate(expression, [&](LeafId leaf) {
      for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
        if (cell.leaves[i] == leaf) return (state >> i & 1) != 0;
      }
      return false;
    });
    if (!point.value) continue;
    cell.table |= std::uint64_t{1} << state;
    if (!first && owner != point.owner) owner.value = Owner::varies;
    if (first) owner = point.owner;
    first = false;
  }
  cell.owner = owner.value;
}

// Rounded outward by the slack, which exceeds what the conversion rounds.
float to_float(double value) {
  return static_cast<float>(value);
}

class Collapser {
 public:
  Collapser(const Subdivision& subdivision, CellTree& tree) : subdivision_(subdivision), tree_(tree) {}

  // Opens the largest of a node's children until there are eight.
  void collapse(std::uint32_t root) {
    tree_.nodes.emplace_back();
    struct Pending {
      std::uint32_t from;
      std::size_t to;
      int depth;
    };
    std::vector<Pending> pending{{root, 0, 1}};
    std::vector<std::uint32_t> children;
    while (!pending.empty()) {
      const Pending next = pending.back();
      pending.pop_back();
      tree_.depth = std::max(tree_.depth, next.depth);
      children.assign(1, next.from);
      while (children.size() < node_width) {
        std::size_t largest = children.size();
        double area = -1;
        for (std::size_t i = 0; i < children.size(); ++i) {
          const SubdivisionNode& child = subdivision_.nodes[children[i]];
          if (child.cell != SubdivisionNode::none || child.box.surface_area() <= area) continue;
          area = child.box.surface_area();
          largest = i;
        }
        if (largest == children.size()) break;
        const SubdivisionNode& opened = subdivision_.nodes[children[largest]];
        children[largest] = opened.left;
        children.push_back(opened.right);
      }
      for (std::size_t i = 0; i < node_width; ++i) {
        if (i >= children.size()) {
          set_child(next.to, i, Box3::empty(), {});
          continue;
        }
        const SubdivisionNode& child = subdivision_.nodes[children[i]];
        if (child.cell != SubdivisionNode::none) {
          set_child(next.to, i, child.box, ChildRef::cell(child.cell));
        } else {
          const std::size_t index = tree_.nodes.size();
          tree_.nodes.emplace_back();
          set_child(next.to, i, child.box, ChildRef::node(index));
          pending.push_back({children[i], index, next.depth + 1});
        }
      }
    }
  }

 private:
  void set_child(std::size_t node, std::size_t lane, const Box3& box, ChildRef child) {
    WideNode& wide = tree_.nodes[node];
    wide.children[lane] = child;
    const Box3 relative = grown(Box3{box.lower - tree_.center, box.upper - tree_.center}, tree_.scale.slack);
    for (int axis = 0; axis < 3; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      constexpr float inf = std::numeric_limits<float>::infinity();
      wide.ends[a][0][lane] = box.is_empty() ? inf : to_float(relative.lower[axis]);
      wide.ends[a][1][lane] = box.is_empty() ? -inf : to_float(relative.upper[axis]);
    }
  }

  const Subdivision& subdivision_;
  CellTree& tree_;
};

}  // namespace

CellTree CellTree::build(const CsgTree& tree, const Box3& box, const BuildQuality& quality, int threads) {
  CellTree result;
  result.scale = CellScale::of(tree);
  result.box = grown(box, 4 * result.scale.growth);
  result.center = result.box.center();
  const Subdivision subdivision = subdivide(tree, result.scale, result.box, quality, threads);
  result.shapes = PlacedShapes::of(tree, result.scale);
  if (subdivision.root == SubdivisionNode::none) return result;

  result.cells.reserve(subdivision.cells.size());
  for (const BoundaryCell& boundary : subdivision.cells) {
    Cell cell;
    result.most_leaves = std::max(result.most_leaves, boundary.leaf_count);
    const std::span<const Symbol> expression{subdivision.symbols.data() + boundary.first_symbol, boundary.symbol_count};
    if (boundary.leaf_count <= Cell::most_tabled) {
      for (const Symbol& s : expression) {
        if (s.kind != Symbol::Kind::leaf) continue;
        const ShapeRef shape = result.shapes.of_leaf[s.leaf.get()];
        cell.leaves[cell.leaf_count] = s.leaf;
        cell.shapes[cell.leaf_count] = shape;
        cell.general |= shape.kind() == ShapeKind::general;
        ++cell.leaf_count;
      }
      tabulate(expression, cell);
    } else {
      cell.extended = true;
      cell.owner = Owner::varies;
      cell.table = result.extended.size();
      ExtendedCell extended;
      extended.first_symbol = static_cast<std::uint32_t>(result.symbols.size());
      extended.first_leaf = static_cast<std::uint32_t>(result.extended_leaves.size());
      extended.leaf_count = boundary.leaf_count;
      if (boundary.leaf_count <= Cell::most_followed) {
        extended.symbol_count = boundary.symbol_count;
        result.symbols.insert(result.symbols.end(), expression.begin(), expression.end());
        for (const Symbol& s : expression) {
          if (s.kind == Symbol::Kind::leaf) result.extended_leaves.push_back(s.leaf);
        }
      }
      result.extended.push_back(extended);
    }
    result.cells.push_back(cell);
  }
  Collapser(subdivision, result).collapse(subdivision.root);
  result.depth = std::max(result.depth, subdivision.depth);
  return result;
}

std::vector<std::pair<std::string, double>> CellTree::details() const {
  std::array<std::size_t, Cell::most_tabled + 1> by_count{};
  std::size_t varying = 0, general = 0;
  for (const Cell& cell : cells) {
    if (cell.extended) continue;
    ++by_count[cell.leaf_count];
    varying += cell.owner == Owner::varies;
    general += cell.general;
  }
  std::vector<std::pair<std::string, double>> result{{"nodes", static_cast<double>(nodes.size())},
                                                     {"boundary cells", static_cast<double>(cells.size())}};
  for (std::size_t count = 1; count <= Cell::most_tabled; ++count) {
    result.emplace_back("cells of " + std::to_string(count) + (count == 1 ? " leaf" : " leaves"),
                        static_cast<double>(by_count[count]));
  }
  result.emplace_back("cells of more leaves", static_cast<double>(extended.size()));
  result.emplace_back("leaves in the fullest cell", most_leaves);
  result.emplace_back("cells with leaves of no special kind", static_cast<double>(general));
  result.emplace_back("cells of several materials", static_cast<double>(varying));
  return result;
}

std::size_t CellTree::memory_bytes() const {
  return nodes.size() * sizeof(WideNode) + cells.size() * sizeof(Cell) + extended.size() * sizeof(ExtendedCell) +
         symbols.size() * sizeof(Symbol) + extended_leaves.size() * sizeof(LeafId) + shapes.memory_bytes();
}

}  // namespace tenon::cells
