#include "accel/macdonald_booth.h"

#include <algorithm>

namespace tenon {

std::optional<AxisPlane> MacDonaldBooth::choose(const std::vector<EnclosedLeaf>& leaves,
                                                const std::vector<std::uint32_t>& items, const Box3& cell) {
  best_.reset();
  for (int axis = 0; axis < 3; ++axis) {
    lowers_.clear();
    uppers_.clear();
    centers_.clear();
    for (const std::uint32_t i : items) {
      const Box3& box = leaves[i].box;
      lowers_.push_back(box.lower[axis]);
      uppers_.push_back(box.upper[axis]);
      centers_.push_back(box.center()[axis]);
    }
    std::sort(lowers_.begin(), lowers_.end());
    std::sort(uppers_.begin(), uppers_.end());
    const auto half = centers_.begin() + static_cast<std::ptrdiff_t>(centers_.size() / 2);
    std::nth_element(centers_.begin(), half, centers_.end());

    const double middle = cell.center()[axis], median = *half;
    const double from = std::min(middle, median), to = std::max(middle, median);
    try_plane(cell, {axis, middle});
    try_plane(cell, {axis, median});
    for (const std::vector<double>* ends : {&lowers_, &uppers_}) {
      auto end = std::lower_bound(ends->begin(), ends->end(), from);
      for (; end != ends->end() && *end <= to; ++end) {
        if (end == ends->begin() || *end != *(end - 1)) try_plane(cell, {axis, *end});
      }
    }
  }
  return best_;
}

void MacDonaldBooth::try_plane(const Box3& cell, const AxisPlane& plane) {
  const auto [axis, position] = plane;
  if (!(cell.lower[axis] < position && position < cell.upper[axis])) return;
  Box3 below = cell, above = cell;
  below.upper[axis] = position;
  above.lower[axis] = position;
  const auto count_below = std::lower_bound(lowers_.begin(), lowers_.end(), position) - lowers_.begin();
  const auto count_above = uppers_.end() - std::upper_bound(uppers_.begin(), uppers_.end(), position);
  const double cost =
      below.surface_area() * static_cast<double>(count_below) + above.surface_area() * static_cast<double>(count_above);
  if (best_ && !(cost < best_cost_)) return;
  best_ = plane;
  best_cost_ = cost;
}

}  // namespace tenon
