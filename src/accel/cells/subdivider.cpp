#include "accel/cells/subdivider.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "accel/cells/cell_cost.h"
#include "accel/cells/split_limits.h"
#include "math/axes.h"

namespace tenon::cells {

namespace {

std::pair<Box3, Box3> halves(const Box3& box, const SplitPlane& plane) {
  std::pair<Box3, Box3> result{box, box};
  result.first.upper[plane.axis] = plane.position;
  result.second.lower[plane.axis] = plane.position;
  return result;
}

bool keeps_nearly_all(const SpacePart& part, const SpacePart& whole) {
  return 10 * part.leaves.size() > 9 * whole.leaves.size();
}

}  // namespace

Subdivision Subdivider::subdivide(const SpacePart& part, std::size_t most_cells, Subdivision::Built& root) {
  result_ = {};
  most_cells_ = most_cells;
  root = build(part, 0);
  return std::move(result_);
}

bool Subdivider::split(const SpacePart& part, std::array<SpacePart, 2>& parts) {
  if (!worth_splitting(part)) return false;
  const SplitPlane plane = choose_plane(part);
  if (plane.axis < 0) return false;
  const auto [low, high] = halves(part.box, plane);
  restrict_to(low, part, parts[0]);
  restrict_to(high, part, parts[1]);
  const bool in_vain = keeps_nearly_all(parts[0], part) && keeps_nearly_all(parts[1], part);
  for (SpacePart& side : parts) side.in_vain = in_vain ? part.in_vain + 1 : 0;
  return true;
}

void Subdivider::restrict_to(const Box3& box, const SpacePart& whole, SpacePart& part) {
  const Box3 within = grown(box, input_.scale.growth);
  part.box = box;
  part.depth = whole.depth + 1;
  part.in_vain = 0;
  part.leaves.clear();
  folder_.fold(
      whole.expression, [&](LeafId id) { return input_.regions.classify(id, within); }, part.expression);
  for (const Symbol& s : part.expression) {
    if (s.kind == Symbol::Kind::leaf) part.leaves.push_back(s.leaf);
  }
}

// Recursive, as deep as the limits on splitting allow.
Subdivision::Built Subdivider::build(const SpacePart& part, std::size_t level) {
  if (part.leaves.size() <= Cell::most_tabled) {
    const auto built = tabled_.subdivide(part.box, part.expression, part.depth, most_cells_, result_);
    if (built) return *built;
  }
  result_.depth = std::max(result_.depth, part.depth);
  const Box3 tight = tight_box(part);
  const double whole_cost = tight.surface_area() * leaf_cost(part);
  const auto add_cell = [&] {
    const ChildRef cell = result_.store.add_extended(part.expression, static_cast<std::uint32_t>(part.leaves.size()));
    return Subdivision::Built{result_.add_leaf(tight, cell), whole_cost};
  };
  if (level == levels_.size()) levels_.emplace_back();
  std::array<SpacePart, 2>& parts = levels_[level];
  if (!split(part, parts)) return add_cell();

  const Subdivision::Mark mark = result_.mark();
  std::array<Subdivision::Built, 2> built;
  for (std::size_t side = 0; side < 2; ++side) {
    if (parts[side].has_boundary()) built[side] = build(parts[side], level + 1);
  }
  const Subdivision::Built joined = result_.join(built[0], built[1]);
  if (joined.cost < whole_cost || part.leaves.size() > Cell::most_followed) return joined;
  result_.rewind(mark);
  return add_cell();
}

bool Subdivider::worth_splitting(const SpacePart& part) const {
  if (part.leaves.size() <= 1 || part.depth >= input_.limits.depth) return false;
  if (part.in_vain >= SplitLimits::most_in_vain) return false;
  if (part.in_vain > 0 && part.leaves.size() << part.in_vain > SplitLimits::most_copies) return false;
  if (result_.store.cells.size() > most_cells_) return false;
  double smallest = std::numeric_limits<double>::infinity();
  for (const LeafId id : part.leaves) {
    smallest = std::min(smallest, input_.regions[id].extent);
  }
  // More leaves than a word of truth values has room for cost much more.
  const double finest = input_.quality.finest / 4;
  const double edge = max_component(part.box.size());
  return edge > finest * smallest && edge > 8 * input_.scale.growth;
}

SplitPlane Subdivider::choose_plane(const SpacePart& part) {
  SplitPlane best;
  choose_by_bounds(part, best);
  if (part.leaves.size() > most_folded) return best;
  planes_.clear();
  if (best.axis >= 0) planes_.push_back(best);
  const Vec3 size = part.box.size();
  const int beside = input_.quality.beside;
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] < max_component(size) / 8) continue;
    for (int i = 0; i <= 2 * beside; ++i) {
      planes_.push_back({axis, evenly_spaced(part.box.lower[axis], part.box.upper[axis], i, beside)});
    }
  }
  trials_.prepare(part.expression, part.leaves, part.box, planes_);
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const auto [low, high] = halves(part.box, planes_[i]);
    double price = low.surface_area() * trials_.folded_cost(i, 0, low);
    if (price >= least) continue;
    price += high.surface_area() * trials_.folded_cost(i, 1, high);
    if (price >= least) continue;
    least = price;
    best = planes_[i];
  }
  return best;
}

// The cheapest of evenly spaced planes by the leaves' bounds alone, each leaf being looked at once.
void Subdivider::choose_by_bounds(const SpacePart& part, SplitPlane& best) const {
  constexpr std::size_t bins = 16;
  using Sums = std::array<double, bins>;
  std::array<Sums, 3> begins{}, ends{};
  const Vec3 size = part.box.size();
  constexpr double bin_count = static_cast<double>(bins);
  const Vec3 bins_per_length{bin_count / size.x, bin_count / size.y, bin_count / size.z};
  constexpr std::size_t ahead = 8;  // leaves of a large scene come from memory, those of a part from all over it
  for (std::size_t i = 0; i < part.leaves.size(); ++i) {
    if (i + ahead < part.leaves.size()) {
      const RegionLeaf& later = input_.regions[part.leaves[i + ahead]];
      hwy::Prefetch(&later.bounds);
      hwy::Prefetch(&later.price);
    }
    const RegionLeaf& leaf = input_.regions[part.leaves[i]];
    for_each_axis([&](auto axis) {
      const auto bin_of = [&](double p) {
        const double place = (p - part.box.lower[axis]) * bins_per_length[axis];
        return static_cast<std::size_t>(std::clamp(place, 0.0, bin_count - 1));
      };
      begins[axis][bin_of(leaf.bounds.lower[axis])] += static_cast<double>(leaf.price);
      ends[axis][bin_of(leaf.bounds.upper[axis])] += static_cast<double>(leaf.price);
    });
  }
  double least = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (!(size[axis] > 8 * input_.scale.growth)) continue;
    Sums above{};
    double sum = 0;
    for (std::size_t i = bins; i-- > 0;) above[i] = sum += ends[a][i];
    double below = 0;
    for (std::size_t i = 1; i < bins; ++i) {
      below += begins[a][i - 1];
      const SplitPlane plane{axis,
                             part.box.lower[axis] + size[axis] * static_cast<double>(i) / static_cast<double>(bins)};
      const auto [low, high] = halves(part.box, plane);
      const double price = low.surface_area() * below + high.surface_area() * above[i];
      if (price >= least) continue;
      least = price;
      best = plane;
    }
  }
}

double Subdivider::leaf_cost(const SpacePart& part) const {
  double sum = 0;
  for (const LeafId id : part.leaves) sum += static_cast<double>(input_.regions[id].price);
  return CellCost::of_cell(sum, part.leaves.size());
}

// The boundary lies on the leaves, so within their bounds.
Box3 Subdivider::tight_box(const SpacePart& part) const {
  Box3 around;
  for (const LeafId id : part.leaves) around = hull(around, input_.regions[id].bounds);
  return intersection(part.box, grown(around, input_.scale.growth));
}

}  // namespace tenon::cells
