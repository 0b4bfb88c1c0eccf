// Rays in the frame of the scene, one a lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_SCENE_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_SCENE_RAYS_INL_H_
#undef TENON_ACCEL_CELLS_SCENE_RAYS_INL_H_
#else
#define TENON_ACCEL_CELLS_SCENE_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include "accel/cells/chord-inl.h"
#include "accel/cells/leaf_records.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Products and sums that round once where the machine can: for what is within the certainty of a record in any case,
/// and needs no bits of its own.
template <class D>
HWY_INLINE hn::Vec<D> FusedDot(const Vec3Lanes<D>& a, const Vec3Lanes<D>& b) {
  return hn::MulAdd(a.z, b.z, hn::MulAdd(a.y, b.y, hn::Mul(a.x, b.x)));
}
template <class D>
HWY_INLINE Vec3Lanes<D> FusedMulAdd(hn::Vec<D> t, const Vec3Lanes<D>& d, const Vec3Lanes<D>& o) {
  return {hn::MulAdd(t, d.x, o.x), hn::MulAdd(t, d.y, o.y), hn::MulAdd(t, d.z, o.z)};
}

/// Rays that start where they meet the scene, relative to the tree's centre.
template <class D>
struct SceneRays {
  Vec3Lanes<D> origin, direction;
  Vec3Lanes<D> slowness;      ///< 1 / direction, by component; large instead of infinite
  hn::Vec<D> inverse_square;  ///< 1 / |direction|²
  hn::Vec<D> length;          ///< |direction|
  hn::Vec<D> near;            ///< crossings no further apart than this may be one boundary
  bool flat;                  ///< some ray is nearly parallel to an axis plane
};

/// The part of a ray inside a convex solid, or inside the only part of another that it meets.
template <class D>
struct Stretch {
  hn::Vec<D> enter, leave;
  hn::Mask<D> hit, unsure;
};

/// The numbers of one record, for all rays.
template <class D>
struct SharedRecord {
  const double* values;

  HWY_INLINE hn::Vec<D> operator[](std::size_t i) const { return hn::Set(D(), values[i]); }
};

/// Those of a record a lane, all of one kind.
template <class D>
struct LaneRecords {
  const double* const* first;  ///< where each begins

  HWY_INLINE hn::Vec<D> operator[](std::size_t i) const {
    return TakeEach(D(), [&](std::size_t lane) { return first[lane][i]; });
  }
};

template <class D, class Record>
HWY_INLINE Vec3Lanes<D> Load3(D, const Record& r, std::size_t i) {
  return {r[i], r[i + 1], r[i + 2]};
}
template <class D, class Record>
HWY_INLINE Vec3Lanes<D> Map3(D d, const Record& r, std::size_t i, const Vec3Lanes<D>& v) {
  return {FusedDot(Load3(d, r, i), v), FusedDot(Load3(d, r, i + 3), v), FusedDot(Load3(d, r, i + 6), v)};
}

/// For masks what IfThenElse is for vectors.
template <class M>
HWY_INLINE M Choose(M condition, M then, M otherwise) {
  return hn::Or(hn::And(condition, then), hn::AndNot(condition, otherwise));
}

/// What is shorter than this is grazed.
template <class D>
HWY_INLINE hn::Vec<D> ShortestStretch(D d, const SceneRays<D>& ray) {
  return hn::Mul(hn::Set(d, 2.0), ray.near);
}

template <class D>
HWY_INLINE void DoubtShort(D d, const SceneRays<D>& ray, Stretch<D>& s) {
  const auto width = hn::Sub(s.leave, s.enter);
  s.unsure = hn::Or(s.unsure, hn::And(s.hit, hn::Le(hn::Abs(width), ShortestStretch(d, ray))));
  s.hit = hn::And(s.hit, hn::Gt(width, hn::Zero(d)));
}

/// From where the ray is nearest to a point, so that no term is larger than the solid asks.
template <class D>
HWY_INLINE hn::Vec<D> Approach(const SceneRays<D>& ray, const Vec3Lanes<D>& from, Vec3Lanes<D>& place) {
  const auto nearest = hn::Neg(hn::Mul(FusedDot(from, ray.direction), ray.inverse_square));
  place = FusedMulAdd(nearest, ray.direction, from);
  return nearest;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
