// Cells where instances stand among other leaves. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_INSTANCE_CELL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_INSTANCE_CELL_INL_H_
#undef TENON_ACCEL_CELLS_INSTANCE_CELL_INL_H_
#else
#define TENON_ACCEL_CELLS_INSTANCE_CELL_INL_H_
#endif

#include <hwy/highway.h>

#include <optional>

#include "accel/cells/instance_ray-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Follows a ray through a cell where instances stand among other leaves: the crossings of each leaf are found one
/// after another, and the truth table from one to the next.
/// @tparam Tracer  SingleTracer, which has begun the ray
template <class Tracer>
class InstanceCell {
 public:
  /// @param t_in, t_out  counted from where the ray meets the scene
  InstanceCell(Tracer& tracer, const Cell& cell, double t_in, double t_out)
      : tracer_(tracer), cell_(cell), t_in_(t_in), t_out_(t_out) {}

  /// The first boundary in the cell.
  Outcome Meet(CellAnswer& answer) {
    if (cell_.values == Cell::Values::several) return Outcome::unsure;
    std::uint32_t state = 0;
    for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
      if (!Start(i)) return Outcome::unsure;
      state |= static_cast<std::uint32_t>(leaves_[i].inside) << i;
    }
    const std::uint32_t before = state;
    for (;;) {
      std::uint32_t first = 0;
      for (std::uint32_t i = 1; i < cell_.leaf_count; ++i) {
        if (leaves_[i].next < leaves_[first].next) first = i;
      }
      if (!(leaves_[first].next <= t_out_ + tracer_.start_)) return Outcome::passed;
      if (IsCrowded(first)) return Outcome::unsure;
      state ^= 1U << first;
      if ((cell_.table >> state & 1) != (cell_.table >> before & 1)) {
        Tell(leaves_[first], before, state, answer);
        return Outcome::met;
      }
      if (!Pass(leaves_[first])) return Outcome::unsure;
    }
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  // Where the ray is with respect to a leaf. All t are those of the query.
  struct Progress {
    std::optional<InstanceRay<Tracer>> instance;
    double last = -never, next = never, behind = never;  // crossings; `behind` of a leaf that is no instance
    bool inside = false;
    CellAnswer crossing;  // the next
  };

  double near() const { return tracer_.asked_.near; }

  // Whether another leaf may be crossed where the ray crosses one next.
  bool IsCrowded(std::uint32_t first) const {
    const double t = leaves_[first].next;
    for (std::uint32_t i = 0; i < cell_.leaf_count; ++i) {
      if (i != first && (leaves_[i].next - t <= near() || t - leaves_[i].last <= near())) return true;
    }
    return false;
  }

  void Tell(const Progress& leaf, std::uint32_t before, std::uint32_t after, CellAnswer& answer) const {
    const std::uint32_t index = answer.cell;
    answer = leaf.crossing;
    answer.cell = index;
    tracer_.TellBoundary(cell_, before, after, answer);
    // The others have their last bits.
    if (!leaf.instance) tracer_.Finish(answer);
  }

  // The leaf at a place, where the ray comes into the cell. @return whether that is certain
  bool Start(std::uint32_t place) {
    Progress& leaf = leaves_[place];
    const double start = tracer_.start_;
    if (cell_.records[place].kind() == RecordKind::instance) {
      leaf.instance.emplace(tracer_.instance_ray(cell_, place));
      // From where another crossing may be one with the first in the cell.
      leaf.last = std::max(t_in_ + start - 2 * near(), tracer_.asked_.begin);
      if (!FindNext(leaf)) return false;
      while (leaf.next <= t_in_ + start) {
        if (!Pass(leaf)) return false;
      }
      return true;
    }
    double enter, leave;
    if (!tracer_.FindLeaf(cell_, place, t_in_, t_out_, enter, leave)) return false;
    leaf.inside = enter <= t_in_ && t_in_ < leave;
    leaf.last = (enter <= t_in_ ? leave <= t_in_ ? leave : enter : -never) + start;
    leaf.next = (leaf.inside ? leave : enter > t_in_ ? enter : never) + start;
    leaf.behind = leaf.inside || !(enter > t_in_) ? never : leave + start;
    leaf.crossing.t = leaf.next;
    leaf.crossing.leaf_entering = !leaf.inside;
    leaf.crossing.surface = {cell_.leaves[place], 0};
    return true;
  }

  // Passes the next crossing of a leaf. @return whether it is certain where the one behind it is
  bool Pass(Progress& leaf) {
    leaf.last = leaf.next;
    leaf.inside = !leaf.inside;
    if (leaf.instance) return FindNext(leaf);
    leaf.crossing.t = leaf.next = std::exchange(leaf.behind, never);
    leaf.crossing.leaf_entering = false;
    return true;
  }

  // The crossing of an instance behind the last one, and with it whether the ray is inside. Crossings of a part are
  // further apart than `near`.
  bool FindNext(Progress& leaf) {
    const double from = std::max(leaf.last + 0.5 * near(), tracer_.asked_.begin);
    const Outcome outcome = leaf.instance->Next(from, never, Wanted::boundary, leaf.crossing, *tracer_.counters_);
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
  Progress leaves_[Cell::most_tabled];
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
