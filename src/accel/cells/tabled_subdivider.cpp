#include "accel/cells/tabled_subdivider.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "accel/cells/cell_cost.h"
#include "accel/cells/split_limits.h"

namespace tenon::cells {

namespace {

template <class Body>
void for_each_bit(std::uint32_t bits, const Body& body) {
  for (; bits != 0; bits &= bits - 1) body(static_cast<std::size_t>(std::countr_zero(bits)));
}

}  // namespace

Subdivision::Built TabledSubdivider::subdivide(const Box3& box, std::span<const Symbol> expression, int depth,
                                               std::size_t most_cells, Subdivision& result) {
  expression_.assign(expression);
  most_cells_ = most_cells;
  result_ = &result;
  for (std::size_t i = 0; i < expression_.leaf_count; ++i) leaves_[i] = input_.regions[expression_.leaves[i]];
  Rest rest{expression_.value, TruthTable::always, (1U << expression_.leaf_count) - 1};
  drop_irrelevant(rest);
  if (rest.leaves == 0) return {};
  price_cells();
  return build(make_part(box, rest, depth));
}

// Recursive, as deep as the limits on splitting allow.
Subdivision::Built TabledSubdivider::build(const Part& part) {
  result_->depth = std::max(result_->depth, part.depth);
  const auto as_cell = [&] { return Subdivision::Built{result_->add_leaf(part.tight, add_cell(part)), part.cost}; };
  if (!worth_splitting(part)) return as_cell();
  const SplitPlane plane = choose_plane(part);
  if (plane.axis < 0) return as_cell();

  Box3 low = part.box, high = part.box;
  low.upper[plane.axis] = high.lower[plane.axis] = plane.position;
  std::array<Part, 2> parts{part_within(part, low), part_within(part, high)};
  const double step = CellCost::split * part.tight.surface_area();
  const bool pays = parts[0].cost + parts[1].cost + step < part.cost * SplitLimits::least_gain;
  const Subdivision::Mark mark = result_->mark();
  std::array<Subdivision::Built, 2> built;
  for (std::size_t side = 0; side < 2; ++side) {
    if (parts[side].rest.leaves == 0) continue;
    parts[side].unpaid = pays ? 0 : part.unpaid + 1;
    built[side] = build(parts[side]);
  }
  const Subdivision::Built joined = result_->join(built[0], built[1]);
  if (joined.cost < part.cost) return joined;
  result_->rewind(mark);
  return as_cell();
}

bool TabledSubdivider::worth_splitting(const Part& part) const {
  if (std::popcount(part.rest.leaves) <= 1 || result_->store.cells.size() > most_cells_) return false;
  if (part.depth >= SplitLimits::deepest) return false;
  // What costs twice as much is worth one more try.
  if (part.unpaid >= input_.quality.look_ahead + std::ilogb(cell_cost_[part.rest.leaves])) return false;
  double smallest = std::numeric_limits<double>::infinity();
  for_each_bit(part.rest.leaves,
               [&](std::size_t i) { smallest = std::min(smallest, max_component(leaves_[i].bounds.size())); });
  const double edge = max_component(part.box.size());
  return edge > input_.quality.finest * smallest && edge > 8 * input_.scale.growth;
}

void TabledSubdivider::price_cells() {
  cell_cost_[0] = 0;
  for (std::uint32_t leaves = 1; leaves < (1U << expression_.leaf_count); ++leaves) {
    const std::uint32_t others = leaves & (leaves - 1);
    const auto first = static_cast<std::size_t>(std::countr_zero(leaves));
    cell_cost_[leaves] =
        (others == 0 ? CellCost::visit : cell_cost_[others]) + static_cast<double>(leaves_[first].price);
  }
}

SplitPlane TabledSubdivider::choose_plane(const Part& part) {
  const double growth = input_.scale.growth;
  const Box3 within = grown(part.box, growth);
  std::array<BoxRegions, most> leaves;
  for_each_bit(part.rest.leaves, [&](std::size_t i) { leaves[i] = BoxRegions(input_.regions, leaves_[i], within); });
  SplitPlane best;
  double least = std::numeric_limits<double>::infinity();
  const Vec3 size = part.box.size();
  const double longest = max_component(size);
  for (int axis = 0; axis < 3; ++axis) {
    if (size[axis] < longest / 8) continue;
    list_candidates(part, axis);
    const double across = size[(axis + 1) % 3] * size[(axis + 2) % 3];
    const double around = size[(axis + 1) % 3] + size[(axis + 2) % 3];
    const auto price = [&](double low, double high) {
      Regions regions;
      for_each_bit(part.rest.leaves,
                   [&](std::size_t i) { regions.set(i, leaves[i].classify(axis, low - growth, high + growth)); });
      return (across + (high - low) * around) * cell_cost_[fold(part.rest, regions).leaves];
    };
    for (const double position : positions_) {
      double sum = price(part.box.lower[axis], position);
      if (sum < least) sum += price(position, part.box.upper[axis]);
      if (!(sum < least)) continue;
      least = sum;
      best = {axis, position};
    }
  }
  return best;
}

// Evenly spaced planes and the bounds of leaves, a little off, so that faces do not lie in planes.
void TabledSubdivider::list_candidates(const Part& part, int axis) {
  positions_.clear();
  const double low = part.box.lower[axis], high = part.box.upper[axis];
  for (int i = 1; i <= input_.quality.candidates; ++i) {
    positions_.push_back(low + i / (input_.quality.candidates + 1.0) * (high - low));
  }
  const double off = 4 * input_.scale.growth;
  for_each_bit(part.rest.leaves, [&](std::size_t i) {
    const Box3& b = leaves_[i].bounds;
    for (const double p : {b.lower[axis] - off, b.upper[axis] + off}) {
      if (p > low + off && p < high - off) positions_.push_back(p);
    }
  });
}

// The expression in a smaller part, given where that lies with respect to the leaves.
TabledSubdivider::Rest TabledSubdivider::fold(Rest rest, const Regions& regions) {
  const std::uint32_t settled = regions.outside | regions.inside;
  if (settled == 0) return rest;
  for_each_bit(settled, [&](std::size_t i) {
    const bool inside = (regions.inside >> i & 1) != 0;
    const std::uint64_t states = TruthTable::variable(i).word;
    rest.value = rest.value.where(i, inside);
    rest.possible &= inside ? states : ~states;
  });
  rest.leaves &= ~settled;
  drop_irrelevant(rest);
  return rest;
}

void TabledSubdivider::drop_irrelevant(Rest& rest) {
  for_each_bit(rest.leaves, [&](std::size_t i) {
    if (!rest.value.depends_on(i)) rest.leaves &= ~(1U << i);
  });
}

TabledSubdivider::Part TabledSubdivider::make_part(const Box3& box, const Rest& rest, int depth) const {
  // The boundary lies on the leaves, so within their bounds.
  Box3 around;
  for_each_bit(rest.leaves, [&](std::size_t i) { around = hull(around, leaves_[i].bounds); });
  const Box3 tight = intersection(box, grown(around, input_.scale.growth));
  return {box, rest, tight, tight.surface_area() * cell_cost_[rest.leaves], depth, 0};
}

TabledSubdivider::Part TabledSubdivider::part_within(const Part& part, const Box3& box) const {
  const Box3 within = grown(box, input_.scale.growth);
  Regions regions;
  for_each_bit(part.rest.leaves, [&](std::size_t i) { regions.set(i, input_.regions.classify(leaves_[i], within)); });
  return make_part(box, fold(part.rest, regions), part.depth + 1);
}

ChildRef TabledSubdivider::add_cell(const Part& part) {
  Cell cell;
  std::array<std::uint32_t, most> variables{};
  for_each_bit(part.rest.leaves, [&](std::size_t i) {
    const LeafId leaf = expression_.leaves[i];
    const RecordRef record = input_.records.of_leaf[leaf.get()];
    variables[cell.leaf_count] = 1U << i;
    cell.leaves[cell.leaf_count] = leaf;
    cell.records[cell.leaf_count] = record;
    cell.general |= record.kind() == RecordKind::general;
    ++cell.leaf_count;
  });
  for (std::uint32_t state = 0; state < (1U << cell.leaf_count); ++state) {
    std::uint32_t whole_state = 0;
    for_each_bit(state, [&](std::size_t i) { whole_state |= variables[i]; });
    cell.table |= (part.rest.value.word >> whole_state & 1) << state;
  }
  cell.owner = expression_.owner_in(part.rest.value.word & part.rest.possible).value;
  return result_->store.add(cell);
}

}  // namespace tenon::cells
