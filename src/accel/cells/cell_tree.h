#pragma once

#include <hwy/cache_control.h>

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "accel/cells/cell_store.h"
#include "accel/cells/leaf_records.h"
#include "accel/cells/placed_shape.h"
#include "accel/cells/subdivision.h"
#include "accel/cells/wide_node.h"

namespace tenon::cells {

/// The boundary cells of a scene under a tree of eight-wide nodes. Cells do not overlap (but for the slack), so the
/// first boundary in the first cell is the answer.
struct CellTree : CellStore {
  Vec3 center;
  Box3 box;  ///< of the whole solid, absolute
  /// The same numbers, as vectors take them.
  struct Frame {
    alignas(32) std::array<double, 4> low{}, high{}, center{};
  } frame;
  CellScale scale;
  HugePageVector<WideNode> nodes;
  LeafRecords records;
  PlacedShapes shapes;
  OwnerRanks ranks;
  int depth = 0;
  std::uint32_t most_leaves = 0;  ///< in one cell

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
  std::size_t memory_bytes() const;
  /// Cells by the number of their leaves, and what else tells a good tree from a bad one.
  std::vector<std::pair<std::string, double>> details() const;

  static CellTree build(const CsgTree& tree, const Box3& box, const BuildQuality& quality, int threads,
                        const BuildLimits& limits = {});
};

}  // namespace tenon::cells
