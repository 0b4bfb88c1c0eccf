#include "accel/cells/split_trials.h"

#include "accel/cells/cell_cost.h"

namespace tenon::cells {

void SplitTrials::prepare(const LocalExpression& expression, std::span<const LeafId> leaves, const Box3& box,
                          std::span<const SplitPlane> planes) {
  constexpr std::size_t width = LeafLanes::width;
  expression_ = expression;
  std::size_t next = 0;
  for (Symbol& s : expression_) {
    if (s.kind == Symbol::Kind::leaf) s.leaf = LeafId{next++};
  }
  leaves_.clear();
  for (const LeafId id : leaves) leaves_.push_back(&regions_[id]);
  groups_.resize((leaves.size() + width - 1) / width);
  for (std::size_t i = 0; i < leaves.size(); ++i) groups_[i / width].set(i % width, *leaves_[i], regions_.margin());
  plane_count_ = planes.size();
  sides_.resize(groups_.size() * plane_count_);
  const Box3 within = grown(box, growth_);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    classify_sides(groups_[g], within, planes, growth_, std::span(sides_).subspan(g * plane_count_, plane_count_));
  }
}

double SplitTrials::folded_cost(std::size_t plane, std::size_t side, const Box3& box) {
  const Box3 within = grown(box, growth_);
  const auto region_of = [&](LeafId number) {
    const std::size_t group = number.get() / LeafLanes::width, lane = number.get() % LeafLanes::width;
    const TableRegions& regions = sides_[group * plane_count_ + plane][side];
    if ((regions.outside >> lane & 1) != 0) return Region::outside;
    if ((regions.inside >> lane & 1) != 0) return Region::inside;
    if ((groups_[group].shaped >> lane & 1) != 0) return regions_.classify(*leaves_[number.get()], within);
    return Region::straddles;
  };
  if (folder_.fold(expression_, region_of, folded_).constant) return 0;
  double sum = 0;
  std::size_t count = 0;
  for (const Symbol& s : folded_) {
    if (s.kind != Symbol::Kind::leaf) continue;
    sum += static_cast<double>(leaves_[s.leaf.get()]->price);
    ++count;
  }
  return CellCost::of_cell(sum, count);
}

}  // namespace tenon::cells
