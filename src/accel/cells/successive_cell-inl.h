// Cells with leaves whose crossings are found one after another. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_SUCCESSIVE_CELL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_SUCCESSIVE_CELL_INL_H_
#undef TENON_ACCEL_CELLS_SUCCESSIVE_CELL_INL_H_
#else
#define TENON_ACCEL_CELLS_SUCCESSIVE_CELL_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "accel/cells/instance_ray-inl.h"
#include "accel/cells/mesh_ray-inl.h"
#include "accel/cells/truth_table.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Follows a ray through a cell where instances or meshes stand among other leaves: their crossings are found one after
/// another, and no sooner than the value of a place depends on them. Within an intersection, say, one is not asked as
/// long as the ray is outside of another.
/// @tparam Tracer  SingleTracer, which has begun the ray
template <class Tracer>
class SuccessiveCell {
 public:
  /// @param t_in, t_out  counted from where the ray meets the scene
  SuccessiveCell(Tracer& tracer, const Cell& cell, double t_in, double t_out)
      : tracer_(tracer), cell_(cell), t_in_(t_in), t_out_(t_out), whole_(TableOf(cell)) {}

  /// The first boundary in the cell.
  Outcome Meet(CellAnswer& answer) {
    if (cell_.values == Cell::Values::several) return Outcome::unsure;
    for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
      if (!Start(i)) return Outcome::unsure;
    }
    at_ = t_in_ + tracer_.start_;
    for (;;) {
      TruthTable here;
      if (!LearnValue(here)) return Outcome::unsure;
      const std::uint32_t crossed = FirstThatMatters(here);
      if (crossed == none || !(leaves_[crossed]->next <= t_out_ + tracer_.start_)) return Outcome::passed;
      // Crossings at one place may be one step.
      at_ = leaves_[crossed]->next;
      crossed_ = crossed;
      for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
        if (i != crossed && !MoveOn(*leaves_[i])) return Outcome::unsure;
      }
      Progress& leaf = *leaves_[crossed];
      TruthTable before, after;
      if (!LearnValue(before)) return Outcome::unsure;
      leaf.inside = !leaf.inside;
      if (!LearnValue(after)) return Outcome::unsure;
      leaf.inside = !leaf.inside;
      if (before != after) {
        Tell(leaf, before.word != 0, after.word != 0, answer);
        return Outcome::met;
      }
      Leave(leaf);
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  static constexpr std::uint32_t none = Cell::most_tabled;

  // Where the ray is with respect to a leaf. All t are those of the query.
  struct Progress {
    std::variant<std::monostate, InstanceRay<Tracer>, MeshRay> ray;  // of a leaf that has no record
    bool is_known = false;
    // Between these it is not crossed; `behind` is the crossing behind the next of a leaf that has a record.
    double last = -never, next = never, behind = never;
    bool inside = false;
    CellAnswer crossing;  // the next

    bool has_record() const { return ray.index() == 0; }
  };

  // The cell's, which depends on none of the leaves that are not there.
  static TruthTable TableOf(const Cell& cell) {
    TruthTable table{cell.table};
    for (std::size_t i = cell.leaf_count; i < TruthTable::most_variables; ++i) {
      table.word |= table.word << (std::size_t{1} << i);
    }
    return table;
  }

  double near() const { return tracer_.asked_.near; }

  // The value at the place that the ray has come to, by as many leaves as it takes.
  // @return whether it is certain
  bool LearnValue(TruthTable& value) {
    value = whole_;
    for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
      if (leaves_[i]->is_known) value = value.where(i, leaves_[i]->inside);
    }
    for (std::uint32_t i = 0; i < cell_.leaf_count && !value.is_constant(); ++i) {
      if (leaves_[i]->is_known || !value.depends_on(i)) continue;
      if (!Learn(*leaves_[i])) return false;
      value = value.where(i, leaves_[i]->inside);
    }
    return true;
  }

  // The leaf whose next crossing is the first before which the value may change: crossings of leaves are passed over
  // that it does not depend on, the others being where they are.
  std::uint32_t FirstThatMatters(TruthTable value) const {
    std::uint32_t held = 0;
    for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) held |= (leaves_[i]->is_known ? 1U : 0U) << i;
    for (; held != 0;) {
      std::uint32_t first = none;
      for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
        if ((held >> i & 1) != 0 && (first == none || leaves_[i]->next < leaves_[first]->next)) first = i;
      }
      held &= ~(1U << first);
      TruthTable rest = whole_;
      for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
        if ((held >> i & 1) != 0) rest = rest.where(i, leaves_[i]->inside);
      }
      if (rest != value) return first;
    }
    return none;
  }

  void Tell(const Progress& leaf, bool before, bool after, CellAnswer& answer) const {
    const std::uint32_t index = answer.cell;
    answer = leaf.crossing;
    answer.cell = index;
    tracer_.TellBoundary(before, after, answer);
    // The others have their last bits.
    if (leaf.has_record()) tracer_.Finish(answer);
  }

  // The leaf at a place, where the ray comes into the cell. @return whether that is certain
  bool Start(std::uint32_t place) {
    Progress& leaf = leaves_[place].emplace();
    const RecordKind kind = cell_.records[place].kind();
    if (kind == RecordKind::instance) leaf.ray.template emplace<1>(tracer_.instance_ray(cell_, place));
    if (kind == RecordKind::mesh) leaf.ray.template emplace<2>(tracer_.mesh_ray(cell_, place));
    if (!leaf.has_record()) return true;
    double enter, leave;
    if (!tracer_.FindLeaf(cell_, place, t_in_, t_out_, enter, leave)) return false;
    const double start = tracer_.start_;
    leaf.is_known = true;
    leaf.inside = enter <= t_in_ && t_in_ < leave;
    leaf.last = (enter <= t_in_ ? leave <= t_in_ ? leave : enter : -never) + start;
    leaf.next = (leaf.inside ? leave : enter > t_in_ ? enter : never) + start;
    leaf.behind = leaf.inside || !(enter > t_in_) ? never : leave + start;
    leaf.crossing.t = leaf.next;
    leaf.crossing.leaf_entering = !leaf.inside;
    leaf.crossing.surface = {cell_.leaves[place], 0};
    return true;
  }

  // Where the ray has come to, what is known of a leaf. @return whether that is certain
  bool Learn(Progress& leaf) {
    // From where another crossing may be one with the next.
    leaf.last = std::max({at_ - 2 * near(), tracer_.asked_.begin, leaf.last});
    if (!FindNext(leaf)) return false;
    leaf.is_known = true;
    return MoveOn(leaf);
  }

  // Has what is known of a leaf hold where the ray has come to. Of one without a record nothing may be known there.
  // @return whether it is certain: that the leaf is not crossed where another is
  bool MoveOn(Progress& leaf) {
    if (!leaf.is_known) return true;
    const bool is_crossing = crossed_ != none;
    while (leaf.next <= at_ + (is_crossing ? near() : 0)) {
      if (is_crossing && leaf.next >= at_ - near()) return false;
      // Others are asked when they matter again.
      if (!leaf.has_record() && is_crossing && leaf.last < at_ - 2 * near()) {
        leaf.is_known = false;
        return true;
      }
      if (!Pass(leaf)) return false;
    }
    return !is_crossing || leaf.last < at_ - near();
  }

  // Passes the next crossing of a leaf. One without a record is asked for that behind it when it matters again.
  void Leave(Progress& leaf) {
    if (leaf.has_record()) {
      Pass(leaf);
    } else {
      leaf.last = leaf.next;
      leaf.is_known = false;
    }
  }

  // The same, but that the one behind it is found. @return whether it is certain where the one behind it is
  bool Pass(Progress& leaf) {
    leaf.last = leaf.next;
    leaf.inside = !leaf.inside;
    if (!leaf.has_record()) return FindNext(leaf);
    leaf.crossing.t = leaf.next = std::exchange(leaf.behind, never);
    leaf.crossing.leaf_entering = false;
    return true;
  }

  // The crossing of a leaf without a record behind the last one, and with it whether the ray is inside. Those of one
  // leaf are further apart than `near`.
  bool FindNext(Progress& leaf) {
    const double from = std::max(leaf.last + 0.5 * near(), tracer_.asked_.begin);
    const auto find_next = [&](auto& ray) {
      return ray.Next(from, never, Wanted::boundary, leaf.crossing, *tracer_.counters_);
    };
    const auto* const instance = std::get_if<1>(&leaf.ray);
    const Outcome outcome = instance != nullptr ? find_next(*instance) : find_next(std::get<2>(leaf.ray));
    if (outcome == Outcome::unsure) return false;
    // Not the last one again.
    if (outcome == Outcome::met && !(leaf.crossing.t > leaf.last)) return false;
    leaf.next = outcome == Outcome::met ? leaf.crossing.t : never;
    leaf.inside = outcome == Outcome::met && leaf.crossing.before != 0;
    return true;
  }

  Tracer& tracer_;
  const Cell& cell_;
  const double t_in_, t_out_;
  const TruthTable whole_;
  double at_ = 0;                                                  // where the ray has come to
  std::uint32_t crossed_ = none;                                   // what it crosses there
  std::array<std::optional<Progress>, Cell::most_tabled> leaves_;  // as many as the cell has
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
