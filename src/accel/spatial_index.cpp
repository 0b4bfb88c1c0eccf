#include "accel/spatial_index.h"

#include <algorithm>

namespace tenon {

SpatialIndex::SpatialIndex(const Levels& levels) : levels_(levels), elements_(memory_bytes(levels) / sizeof(Number)) {}

void SpatialIndex::fill(const CellRange& cells, Number number) {
  for (std::uint32_t k = cells.first[2]; k <= cells.last[2]; ++k) {
    for (std::uint32_t j = cells.first[1]; j <= cells.last[1]; ++j) {
      const auto row = elements_.begin() + static_cast<std::ptrdiff_t>(place({cells.first[0], j, k}));
      std::fill_n(row, cells.last[0] - cells.first[0] + 1, number);
    }
  }
}

Status check_index_bytes(const std::string& structure, std::size_t needed, const std::string& advice) {
  if (needed <= largest_index_bytes) return success();
  const auto mib = [](std::size_t bytes) { return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB"; };
  return Error{ErrorKind::usage,
               structure + ": the spatial index would need " + mib(needed) + ", more than the " +
                   mib(largest_index_bytes) + " it may take; " + advice,
               {}};
}

}  // namespace tenon
