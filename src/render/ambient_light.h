#pragma once

#include <array>

#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

class Environment;

/// What the world around shows on white matt surfaces that nothing stands before: its irradiance over pi by spherical
/// harmonics up to the second order, which leave out a few hundredths (Ramamoorthi and Hanrahan, "An Efficient
/// Representation for Irradiance Environment Maps", 2001). It is the ambient term of the course's illumination model.
class AmbientLight {
 public:
  explicit AmbientLight(const Environment& around);

  /// @param normal  of length 1
  Rgb operator()(const Vec3& normal) const;

 private:
  static constexpr std::size_t count = 9;
  std::array<Rgb, count> harmonics_{};  // factors of polynomials of the normal; the first one is 1
};

}  // namespace tenon
