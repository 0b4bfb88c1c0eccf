#pragma once

#include <span>
#include <vector>

#include "accel/grid_geometry.h"
#include "csg/enclosures.h"

namespace tenon {

/// For each cell of a grid the leaves whose box reaches into it.
class CellLists {
 public:
  CellLists() = default;
  CellLists(const GridGeometry& grid, const std::vector<EnclosedLeaf>& leaves);

  /// How many entries the lists of a grid would have, all together.
  static std::size_t count_entries(const GridGeometry& grid, const std::vector<EnclosedLeaf>& leaves);

  std::span<const LeafId> of(const CellIndex& cell) const {
    const std::size_t i = place(cell);
    return {leaves_.data() + first_[i], first_[i + 1] - first_[i]};
  }

  std::size_t memory_bytes() const {
    return first_.capacity() * sizeof(std::uint32_t) + leaves_.capacity() * sizeof(LeafId);
  }

 private:
  std::size_t place(const CellIndex& c) const { return (std::size_t{c[2]} * count_[1] + c[1]) * count_[0] + c[0]; }

  CellIndex count_{};
  std::vector<std::uint32_t> first_;  // by cell: its first leaf; one more at the end
  std::vector<LeafId> leaves_;
};

}  // namespace tenon
