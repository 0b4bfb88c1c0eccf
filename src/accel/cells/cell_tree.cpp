#include "accel/cells/cell_tree.h"

#include <algorithm>
#include <array>
#include <optional>

#include "accel/cells/cell_build.h"
#include "accel/cells/leaf_regions.h"
#include "accel/cells/spatial_order.h"
#include "primitive/dispatch.h"
#include "tenon/base/parallel_for.h"

namespace tenon::cells {

namespace {

// Whether rays that go the same way are met together by all that keeps a cell from being followed by its table.
bool is_met_by_packets(const CsgTree& tree, const Cell& cell) {
  if (!is_of_meshes(cell)) return false;
  for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
    if (cell.records[i].kind() != RecordKind::mesh) continue;
    if (!tells_packets(tree.primitives, tree[cell.leaves[i]].primitive)) return false;
  }
  return true;
}

}  // namespace

CellTree CellTree::build(const CsgTree& tree, const Box3& box, const CellScale& scale, const BuildSettings& settings) {
  CellTree result;
  result.scale = scale;
  result.margin = enclosure_margin(tree);
  result.ranks = OwnerRanks(tree);
  // Crossings lie within a resolution of the solid's box, and others matter within 8 on either side (CellScale): a ray
  // that is met by this box comes and goes twice as far beside them, at least. Its cells stand off by the slack of
  // single precision, which is 128 resolutions of a scene.
  result.box = grown(box, 32 * result.scale.resolution);
  result.center = result.box.center();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    result.frame.low[a] = result.box.lower[axis];
    result.frame.high[a] = result.box.upper[axis];
    result.frame.center[a] = result.center[axis];
  }
  const std::vector<LeafId> order = spatial_order(tree, result.scale.reach);
  std::optional<LeafRegions> regions;
  constexpr std::size_t worth_a_thread = 1024;  // leaves: one is ready in a microsecond, a thread in a hundred
  const bool is_large = tree.leaves.size() >= worth_a_thread;
  parallel_for(2, is_large ? settings.threads : 1, [&](std::size_t task, int) {
    if (task == 0) {
      result.records = LeafRecords::of(tree, result.scale, result.center, order);
      regions.emplace(tree, &result.records);
    } else {
      result.shapes = PlacedShapes::of(tree, result.scale, order);
    }
  });
  BuiltCells built = build_cells(
      {tree, result.scale, result.records, *regions, result.ranks, result.center, settings.quality, settings.limits},
      grown(box, 4 * result.scale.growth), result.center, settings.threads);
  static_cast<CellStore&>(result) = std::move(built.store);
  result.nodes = std::move(built.nodes);
  if (!result.pieces.empty()) {
    result.settle_pieces(result.records.append(result.pieces));
    result.pieces = {};
  }
  result.depth = built.depth;
  std::size_t tables = 0, meshes = 0;
  for (const Cell& cell : result.cells) {
    result.most_leaves = std::max(result.most_leaves, result.leaf_count(cell));
    tables += cell.general || cell.extended ? 0 : 1;
    meshes += is_met_by_packets(tree, cell) ? 1 : 0;
  }
  result.has_few_tables = 2 * tables < result.cells.size();
  result.has_packets = 2 * (tables + meshes) >= result.cells.size() && meshes > 0;
  return result;
}

std::vector<std::pair<std::string, double>> CellTree::details() const {
  std::array<std::size_t, Cell::most_tabled + 1> by_count{};
  std::array<std::size_t, 3> by_values{};
  std::size_t varying = 0, general = 0;
  for (const Cell& cell : cells) {
    if (cell.extended) continue;
    ++by_count[cell.leaf_count];
    bool varies = false;
    for (std::uint32_t value = 0; value < ValueTable::most_values; ++value) varies |= owner_of(cell, value).varies();
    varying += varies ? 1 : 0;
    by_values[static_cast<std::size_t>(cell.values)] += 1;
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
  if (!ranks.is_one_medium()) {
    result.emplace_back("cells of opaque solids", static_cast<double>(by_values[0]));
    result.emplace_back("cells between two media", static_cast<double>(by_values[1]));
    result.emplace_back("cells of more media", static_cast<double>(by_values[2]));
  }
  return result;
}

std::size_t CellTree::memory_bytes() const {
  return CellStore::memory_bytes() + nodes.size() * sizeof(WideNode) + records.memory_bytes() + shapes.memory_bytes();
}

}  // namespace tenon::cells
