#pragma once

#include "tenon/math/vec3.h"

namespace tenon {

/// The axes of a camera, orthonormal.
struct CameraFrame {
  Vec3 forward, right, up;

  /// @param view     where it looks, any length but zero
  /// @param up_hint  replaced by the z axis, or by y for a view along z, where it is zero or parallel to the view
  static CameraFrame along(const Vec3& view, const Vec3& up_hint);
};

}  // namespace tenon
