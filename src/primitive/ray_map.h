#pragma once

#include <array>

#include "tenon/math/vec3.h"

namespace tenon {

/// What takes a ray to the frame that a Placement stands for, and bounds what that is wrong by.
struct RayMap {
  using Rows = std::array<Vec3, 3>;

  Vec3 world_origin;  ///< that of the frame
  Rows rows{};        ///< of the linear part
  Vec3 world_center;  ///< rays are moved near to this point
  /// The error of a mapped vector v, per axis: constant_error + relative_error |v|.
  Vec3 constant_error;
  Rows relative_error{};
  Vec3 row_length;  ///< Euclidean, of each of `rows`
};

}  // namespace tenon
