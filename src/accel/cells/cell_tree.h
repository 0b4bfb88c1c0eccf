#pragma once

#include <hwy/cache_control.h>

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "accel/cells/cell_store.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/placed_shape.h"
#include "accel/cells/subdivision.h"
#include "accel/cells/wide_node.h"

namespace tenon::cells {

struct PrototypeCells;

/// The boundary cells of a scene, or of a part that is stored once, under a tree of eight-wide nodes. Cells do not
/// overlap (but for the slack), so the first boundary in the first cell is the answer.
struct CellTree : CellStore {
  Vec3 center;
  Box3 box;  ///< of the whole solid, absolute
  /// The same numbers, as vectors take them.
  struct Frame {
    alignas(32) std::array<double, 4> low{}, high{}, center{};
  } frame;
  CellScale scale;
  double margin = 0;  ///< enclosure_margin(); rays in the frame of an instance ask for no leaf of its cells by it
  HugePageVector<WideNode> nodes;
  LeafRecords records;
  PlacedShapes shapes;
  OwnerRanks ranks;
  std::vector<std::shared_ptr<const PrototypeCells>> prototypes;  ///< by PrototypeId
  int depth = 0;
  std::uint32_t most_leaves = 0;  ///< in one cell
  bool has_few_tables = false;    ///< most cells are left to SingleTracer, so rays are traced one by one from the start
  bool has_packets = false;       ///< but for those that go the same way: they meet the meshes of most cells together

  /// Has what stands below a child come to the cache, for a ray that will be there soon.
  void prefetch(ChildRef child) const {
    if (child.is_cell()) return hwy::Prefetch(&cells[child.index()]);
    const auto* const node = reinterpret_cast<const std::uint8_t*>(&nodes[child.index()]);
    for (std::size_t line = 0; line < sizeof(WideNode); line += 64) hwy::Prefetch(node + line);
  }

  /// What one of the values of a cell's table stands for.
  MediumId medium_of(std::uint32_t cell, std::uint32_t value) const {
    if (ranks.is_one_medium()) return value != 0 ? medium_opaque : medium_outside;
    return CellStore::medium_of(cells[cell], value);
  }
  using CellStore::medium_of;

  bool empty() const { return nodes.empty(); }
  std::size_t memory_bytes() const;  ///< without its prototypes
  /// Cells by the number of their leaves, and what else tells a good tree from a bad one.
  std::vector<std::pair<std::string, double>> details() const;

  /// All but its prototypes.
  /// @param box    around the whole solid
  /// @param scale  of the tree
  static CellTree build(const CsgTree& tree, const Box3& box, const CellScale& scale, const BuildSettings& settings);
};

}  // namespace tenon::cells
