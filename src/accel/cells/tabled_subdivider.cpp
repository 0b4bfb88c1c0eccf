#include "accel/cells/tabled_subdivider.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "accel/cells/cell_cost.h"
#include "accel/cells/planes_recorder.h"
#include "accel/cells/split_limits.h"

namespace tenon::cells {

namespace {

// Of all lines through a box: four times its volume over its surface (Cauchy).
double mean_chord(const Box3& box) {
  const Vec3 size = box.size();
  return 4 * size.x * size.y * size.z / box.surface_area();
}

// Of a ray's way through a leaf, that within a box.
double share_of_way(const RegionLeaf& leaf, const Box3& box) {
  return std::min(1.0, mean_chord(box) / mean_chord(leaf.bounds));
}

}  // namespace

std::optional<Subdivision::Built> TabledSubdivider::subdivide(const Box3& box, std::span<const Symbol> expression,
                                                              int depth, std::size_t most_cells, Subdivision& result) {
  if (!expression_.assign(expression)) return std::nullopt;
  most_cells_ = most_cells;
  result_ = &result;
  FoldedTable rest{expression_.value, TruthTable::always, (1U << expression_.leaf_count) - 1};
  rest.drop_irrelevant();
  if (rest.leaves == 0) return Subdivision::Built{};
  search_.assign(std::span(expression_.leaves).first(expression_.leaf_count));
  const Part whole = make_part(box, rest, depth);
  return whole.rest.leaves == 0 ? Subdivision::Built{} : build(whole);
}

// Recursive, as deep as the limits on splitting allow.
Subdivision::Built TabledSubdivider::build(const Part& part) {
  result_->depth = std::max(result_->depth, part.depth);
  const auto as_cell = [&] { return Subdivision::Built{result_->add_leaf(part.tight, add_cell(part)), part.cost}; };
  if (!worth_splitting(part)) return as_cell();
  const Split split = search_.best_split(part.box, part.rest);
  if (split.plane.axis < 0) return as_cell();

  Box3 low = part.box, high = part.box;
  low.upper[split.plane.axis] = high.lower[split.plane.axis] = split.plane.position;
  std::array<Part, 2> parts{make_part(low, split.rests[0], part.depth + 1),
                            make_part(high, split.rests[1], part.depth + 1)};
  const double step = CellCost::split * part.tight.surface_area();
  const auto pays_by = [&](double Part::*cost) {
    return parts[0].*cost + parts[1].*cost + step < part.*cost * SplitLimits::least_gain;
  };
  const bool pays = pays_by(&Part::cost) || pays_by(&Part::hope);
  const Subdivision::Mark mark = result_->mark();
  std::array<Subdivision::Built, 2> built;
  for (std::size_t side = 0; side < 2; ++side) {
    if (parts[side].rest.leaves == 0) continue;
    parts[side].unpaid = pays || part.is_too_large ? 0 : part.unpaid + 1;
    built[side] = build(parts[side]);
  }
  const Subdivision::Built joined = result_->join(built[0], built[1]);
  if (joined.cost < part.cost) return joined;
  result_->rewind(mark);
  return as_cell();
}

bool TabledSubdivider::worth_splitting(const Part& part) const {
  const bool may_gain = std::popcount(part.rest.leaves) > 1 || part.may_cost_less;
  if (!may_gain || result_->store.cells.size() > most_cells_) return false;
  if (part.depth >= input_.limits.depth) return false;
  // What costs twice as much is worth one more try; where parts are cheaper the smaller they are, up to a point.
  constexpr int most_more = 4;
  int more = std::ilogb(search_.cell_cost(part.rest.leaves));
  if (part.may_cost_less) more = std::min(more, most_more);
  if (part.unpaid >= input_.quality.look_ahead + more) return false;
  double smallest = std::numeric_limits<double>::infinity();
  for_each_bit(part.rest.leaves, [&](std::size_t i) { smallest = std::min(smallest, search_.leaf(i).extent); });
  const double edge = max_component(part.box.size());
  return edge > input_.quality.finest * smallest && edge > 8 * input_.scale.growth;
}

TabledSubdivider::Part TabledSubdivider::make_part(const Box3& box, const FoldedTable& rest, int depth) {
  // The boundary lies on the surfaces of the leaves.
  const Box3 within = grown(box, input_.scale.growth);
  Box3 around;
  // As they are followed, and as the classifier does, which has to follow all of them where one has no record.
  double followed = CellCost::visit, exact = CellCost::visit, hoped = CellCost::visit;
  bool has_unknown = false, may_cost_less = false, is_too_large = false;
  for_each_bit(rest.leaves, [&](std::size_t i) {
    const RegionLeaf& leaf = search_.leaf(i);
    const Box3 surface = input_.regions.surface_within(leaf, within);
    const double exact_price = this->exact_price(leaf, surface);
    exact += exact_price;
    if (leaf.has_pieces && pieces_.find(leaf.leaf, within)) {
      may_cost_less |= pieces_.may_cost_less();
      around = hull(around, pieces_.surface());
      followed += pieces_.price();
      hoped += pieces_.price();
      return;
    }
    may_cost_less |= leaf.has_windows() || leaf.has_pieces;
    is_too_large |= leaf.has_small_pieces && pieces_.was_too_large();
    around = hull(around, surface);
    const bool is_unknown = input_.records.of_leaf[leaf.leaf.get()].kind() == RecordKind::general;
    double price = static_cast<double>(leaf.price);
    if (leaf.is_mesh) price *= std::max(share_of_way(leaf, surface), CellCost::least_share);
    followed += price;
    hoped += is_unknown ? exact_price : price;
    has_unknown |= is_unknown;
  });
  Part part;
  part.box = box;
  part.depth = depth;
  if (around.is_empty()) return part;
  part.rest = rest;
  part.tight = intersection(box, grown(around, input_.scale.growth));
  part.cost = part.tight.surface_area() * (has_unknown ? exact : followed);
  part.hope = part.tight.surface_area() * (has_unknown ? hoped : followed);
  part.may_cost_less = may_cost_less;
  part.is_too_large = is_too_large;
  return part;
}

// Of what the classifier asks of a leaf, some of which is in proportion to the length of a ray's way.
double TabledSubdivider::exact_price(const RegionLeaf& leaf, const Box3& surface) const {
  double price = static_cast<double>(leaf.exact_price);
  if (leaf.has_windows() && !surface.is_empty()) {
    price -= static_cast<double>(leaf.price_of_length) * (1 - share_of_way(leaf, surface));
  }
  return price;
}

// What a leaf is followed by in a part: its own record, or that of what it comes to there.
RecordRef TabledSubdivider::record(LeafId leaf, const Part& part) {
  const RecordRef own = input_.records.of_leaf[leaf.get()];
  if (!input_.regions[leaf].has_pieces) return own;
  if (!pieces_.find(leaf, grown(part.box, input_.scale.growth))) return own;
  return {pieces_.kind(), append_values(pieces_.values(), result_->store.pieces)};
}

ChildRef TabledSubdivider::add_cell(const Part& part) {
  Cell cell;
  bool has_unknown = false;
  std::array<std::uint32_t, SplitSearch::most> variables{};
  for_each_bit(part.rest.leaves, [&](std::size_t i) {
    const LeafId leaf = expression_.leaves[i];
    const RecordRef record = this->record(leaf, part);
    variables[cell.leaf_count] = 1U << i;
    cell.leaves[cell.leaf_count] = leaf;
    cell.records[cell.leaf_count] = record;
    cell.general |= !is_followed(record.kind());
    has_unknown |= record.kind() == RecordKind::general;
    ++cell.leaf_count;
  });
  cell.successive = cell.general && !has_unknown;
  // The values there are, numbered anew: two of them take one bit. That of the outside comes first.
  const ValueTable& whole = part.rest.value;
  std::array<std::uint32_t, std::size_t{1} << SplitSearch::most> values{};
  std::uint32_t present = 0;
  const std::uint32_t states = 1U << cell.leaf_count;
  for (std::uint32_t state = 0; state < states; ++state) {
    std::uint32_t whole_state = 0;
    for_each_bit(state, [&](std::size_t i) { whole_state |= variables[i]; });
    values[state] = whole.value(whole_state);
    present |= 1U << values[state];
  }
  ValueTable table;
  for (std::uint32_t state = 0; state < states; ++state) {
    table.set(std::uint64_t{1} << state,
              static_cast<std::uint32_t>(std::popcount(present & ((1U << values[state]) - 1))));
  }
  cell.table = table.bits[0].word;
  CellMedia media{.more_bits = {table.bits[1].word, table.bits[2].word}};
  std::size_t count = 0;
  for_each_bit(present, [&](std::size_t value) {
    media.media[count] = expression_.media[value];
    media.owners[count++] = expression_.owner_in(whole.states(static_cast<std::uint32_t>(value)) & part.rest.possible);
  });
  if (count == 2 && media.media[0] == medium_outside && media.media[1] == medium_opaque) {
    cell.owner_or_media = media.owners[1].leaf.get();
    return result_->store.add(cell);
  }
  cell.values = count == 2 ? Cell::Values::pair : Cell::Values::several;
  return result_->store.add(cell, media);
}

}  // namespace tenon::cells
