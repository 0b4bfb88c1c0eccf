#pragma once

#include "primitive/clip.h"
#include "tenon/math/box3.h"

namespace tenon {

/// Cuts a chord with a bounded box, whose faces are numbered from `first_face`: two an axis, the lower one first.
/// @return false when nothing is left
inline bool clip_box(const LocalRay& ray, const Box3& box, std::uint32_t first_face, Chord& chord) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::uint32_t face = first_face + 2 * static_cast<std::uint32_t>(axis);
    if (!clip_slab(ray, axis, box.lower[axis], box.upper[axis], face, face + 1, chord)) return false;
  }
  return true;
}

/// The outward normal of a face of a box, counted from 0.
inline Vec3 box_face_normal(std::uint32_t face) {
  Vec3 n;
  n[static_cast<int>(face / 2)] = face % 2 == 0 ? -1 : 1;
  return n;
}

/// The largest n·p over a box.
inline double box_support(const Box3& box, const Vec3& n) {
  const Vec3 low = n * box.lower, high = n * box.upper;
  return std::max(low.x, high.x) + std::max(low.y, high.y) + std::max(low.z, high.z);
}

}  // namespace tenon
