#include "accel/cell_lists.h"

namespace tenon {

CellLists::CellLists(const GridGeometry& grid, const std::vector<EnclosedLeaf>& leaves) : count_(grid.count()) {
  const auto each_entry = [&](auto&& visit) {
    for (const EnclosedLeaf& l : leaves) {
      const CellRange range = grid.range(l.box);
      for (std::uint32_t k = range.first[2]; k <= range.last[2]; ++k) {
        for (std::uint32_t j = range.first[1]; j <= range.last[1]; ++j) {
          for (std::uint32_t i = range.first[0]; i <= range.last[0]; ++i) visit(place({i, j, k}), l.leaf);
        }
      }
    }
  };
  // The ends of the lists first; entering the leaves moves each down to its beginning.
  first_.assign(std::size_t{count_[0]} * count_[1] * count_[2] + 1, 0);
  each_entry([this](std::size_t cell, LeafId) { ++first_[cell]; });
  std::uint32_t end = 0;
  for (std::uint32_t& f : first_) f = end += f;
  leaves_.resize(end);
  each_entry([this](std::size_t cell, LeafId leaf) { leaves_[--first_[cell]] = leaf; });
}

std::size_t CellLists::count_entries(const GridGeometry& grid, const std::vector<EnclosedLeaf>& leaves) {
  std::size_t entries = 0;
  for (const EnclosedLeaf& l : leaves) {
    const CellRange range = grid.range(l.box);
    std::size_t cells = 1;
    for (std::size_t a = 0; a < 3; ++a) cells *= range.last[a] - range.first[a] + 1;
    entries += cells;
  }
  return entries;
}

}  // namespace tenon
