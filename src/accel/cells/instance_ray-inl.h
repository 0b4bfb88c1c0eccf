// A ray in the frame of an instance. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_INSTANCE_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_INSTANCE_RAY_INL_H_
#undef TENON_ACCEL_CELLS_INSTANCE_RAY_INL_H_
#else
#define TENON_ACCEL_CELLS_INSTANCE_RAY_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/exact_cell-inl.h"
#include "accel/cells/prototype_cells.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// A ray as it is in the frame of an instance, followed through the cells of the part.
/// @tparam Tracer  SingleTracer, which follows it
template <class Tracer>
class InstanceRay {
 public:
  /// @param around  has the ray, in the tree that the instance is a leaf of
  InstanceRay(const ExactCell& around, const PrototypeCells& part, LeafId leaf)
      : around_(around),
        part_(part),
        leaf_(leaf),
        on_face_(start_face(*around.ray().query, leaf)),
        mapped_(around.Map(leaf, on_face_)) {}

  /// The first boundary of the part between two places of the ray, all by its t as it was asked.
  /// @param crossing  its `before` and `after` are of the part: 1 within it. Of Wanted::occlusion nothing but t is told
  /// @return unsure where the part's own cells do not tell
  Outcome Next(double from, double until, Wanted wanted, CellAnswer& crossing, TraversalCounters& counters) const {
    if (part_.cells.empty()) return Outcome::passed;
    RayQuery query;
    query.ray = {mapped_.ray.origin, mapped_.ray.direction};
    Hit start;
    if (on_face_ >= 0) {
      const Prototype::Face face = part_.prototype->face_of(static_cast<std::uint32_t>(on_face_));
      start.faces.push_back({face.leaf, face.face});
      query.from = &start;
    }
    const auto to_part = [&](double t) { return t - mapped_.shift; };
    CellAnswer found;
    Tracer(part_.cells, part_.prototype->tree(), around_.scratch(), wanted)
        .TraceWithin(query, mapped_.ray, to_part(around_.ray().begin), to_part(from), to_part(until), found, counters);
    if (found.kind == CellAnswer::Kind::unsure) return Outcome::unsure;
    if (found.kind == CellAnswer::Kind::nothing) return Outcome::passed;
    crossing.kind = CellAnswer::Kind::boundary;
    // As spans() adds it.
    crossing.t = mapped_.shift == 0 ? found.t : found.t + mapped_.shift;
    if (wanted == Wanted::occlusion) return Outcome::met;
    const bool enters = found.after != 0;
    crossing.before = found.before;
    crossing.after = found.after;
    crossing.leaf_entering = enters;
    const Prototype::Face face{found.surface.leaf, found.surface.face, found.leaf_entering != enters};
    crossing.surface = {leaf_, part_.prototype->number_of(face)};
    return Outcome::met;
  }

 private:
  const ExactCell& around_;
  const PrototypeCells& part_;
  LeafId leaf_;
  int on_face_;
  Placement::MappedRay mapped_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
