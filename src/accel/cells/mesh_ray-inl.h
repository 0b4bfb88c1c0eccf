// A ray and a leaf that tells its crossings one after another. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_MESH_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_MESH_RAY_INL_H_
#undef TENON_ACCEL_CELLS_MESH_RAY_INL_H_
#else
#define TENON_ACCEL_CELLS_MESH_RAY_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/exact_cell-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// A ray and a leaf that has no record, but tells its crossings one after another (next_crossing()).
class MeshRay {
 public:
  /// @param around  has the ray
  MeshRay(ExactCell& around, LeafId leaf) : around_(around), leaf_(leaf) {}

  /// The first crossing between two places of the ray, all by its t as it was asked.
  /// @return unsure where all crossings have to tell
  Outcome Next(double from, double until, Wanted /*wanted*/, CellAnswer& crossing,
               TraversalCounters& /*counters*/) const {
    const NextCrossing& next = around_.FindNext(leaf_, from);
    if (next.kind == NextCrossing::Kind::unsure) return Outcome::unsure;
    if (next.kind == NextCrossing::Kind::nothing || next.crossing.t > until) return Outcome::passed;
    crossing.kind = CellAnswer::Kind::boundary;
    crossing.t = next.crossing.t;
    crossing.before = next.crossing.entering ? 0 : 1;
    crossing.after = crossing.before ^ 1;
    crossing.leaf_entering = next.crossing.entering;
    crossing.surface = {leaf_, next.crossing.face};
    return Outcome::met;
  }

 private:
  ExactCell& around_;
  LeafId leaf_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
