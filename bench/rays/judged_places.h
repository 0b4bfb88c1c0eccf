#pragma once

#include <cstddef>

#include "csg/csg_tree.h"
#include "tenon/accel/accelerator.h"
#include "tenon/base/error.h"

namespace tenon::bench {

/// Places along rays, inside and outside of a solid by its spans, judged by the definitions of its primitives.
struct JudgedPlaces {
  std::size_t met = 0;     ///< rays that meet the solid
  std::size_t places = 0;  ///< the middles of every span and of every gap
  std::size_t wrong = 0;   ///< of them
};

/// Sends rays at random through the bounds of a solid of meshes, spheres and boxes. Meshes are judged by their winding
/// numbers (winding_number.h).
///
/// @return an error for a primitive that has no definition here
Result<JudgedPlaces> judge_places(const CsgTree& tree, const Accelerator& accelerator, std::size_t rays);

}  // namespace tenon::bench
