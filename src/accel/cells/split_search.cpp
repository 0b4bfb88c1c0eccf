#include "accel/cells/split_search.h"

#include <bit>
#include <limits>

#include "accel/cells/cell_cost.h"
#include "accel/cells/split_limits.h"
#include "math/axes.h"

namespace tenon::cells {

void SplitSearch::assign(std::span<const LeafId> leaves) {
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    leaves_[i] = regions_[leaves[i]];
    lanes_.set(i, leaves_[i], regions_.margin());
  }
  cell_cost_[0] = 0;
  for (std::uint32_t set = 1; set < (1U << leaves.size()); ++set) {
    const std::uint32_t others = set & (set - 1);
    const auto first = static_cast<std::size_t>(std::countr_zero(set));
    cell_cost_[set] = (others == 0 ? CellCost::visit : cell_cost_[others]) + static_cast<double>(leaves_[first].price);
  }
}

Split SplitSearch::best_split(const Box3& box, const FoldedTable& rest) {
  list_planes(box, rest.leaves);
  sides_.resize(planes_.size());
  const Box3 within = grown(box, growth_);
  classify_sides(lanes_, within, planes_, growth_, sides_);

  Split best;
  double least = std::numeric_limits<double>::infinity();
  const Vec3 size = box.size();
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const auto [axis, position] = planes_[i];
    const double across = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    const double around = size[(axis + 1) % 3] + size[(axis + 2) % 3];
    const bool is_middle = i == 0 || axis != planes_[i - 1].axis;
    const double enough = is_middle ? least : least * SplitLimits::least_advantage;

    Box3 low = within, high = within;
    low.upper[axis] = position + growth_;
    high.lower[axis] = position - growth_;
    const FoldedTable below = rest_in(low, rest, sides_[i][0]);
    double sum = (across + (position - box.lower[axis]) * around) * cell_cost_[below.leaves];
    if (!(sum < enough)) continue;
    const FoldedTable above = rest_in(high, rest, sides_[i][1]);
    sum += (across + (box.upper[axis] - position) * around) * cell_cost_[above.leaves];
    if (!(sum < enough)) continue;
    least = sum;
    best = {planes_[i], {below, above}};
  }
  return best;
}

// Evenly spaced planes, the middle first, and the bounds of leaves, a little off, so that faces do not lie in planes.
// For a cell that costs no more than two balls planes beside the middle do not pay, nor do they among leaves that take
// long to classify, and cost less in any smaller part (by trial on the bench).
void SplitSearch::list_planes(const Box3& box, std::uint32_t leaves) {
  planes_.clear();
  bool is_worth_more = cell_cost_[leaves] > CellCost::visit + 2 * CellCost::of_leaf(RecordKind::ball, 1);
  for_each_bit(leaves, [&](std::size_t i) { is_worth_more &= !leaves_[i].has_windows(); });
  const int beside = is_worth_more ? beside_ : 0;
  const Vec3 size = box.size();
  const double longest = max_component(size), off = 4 * growth_;
  for_each_axis([&](auto axis) {
    if (size[axis] < longest / 8) return;
    const double low = box.lower[axis], high = box.upper[axis];
    for (int i = 0; i <= 2 * beside; ++i) planes_.push_back({axis, evenly_spaced(low, high, i, beside)});
    for_each_bit(leaves, [&](std::size_t i) {
      const Box3& b = leaves_[i].bounds;
      for (const double p : {b.lower[axis] - off, b.upper[axis] + off}) {
        if (p > low + off && p < high - off) planes_.push_back({axis, p});
      }
    });
  });
}

FoldedTable SplitSearch::rest_in(const Box3& grown_side, const FoldedTable& rest, TableRegions regions) const {
  for_each_bit(lanes_.shaped & rest.leaves & ~regions.outside,
               [&](std::size_t i) { regions.set(i, regions_.classify(leaves_[i], grown_side)); });
  return rest.within(regions);
}

}  // namespace tenon::cells
