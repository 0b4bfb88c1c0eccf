#pragma once

#include <optional>
#include <vector>

#include "render/sampler.h"
#include "tenon/math/color.h"
#include "tenon/scene/light.h"

namespace tenon {

/// A direction that the world around sends light from.
struct EnvironmentSample {
  Vec3 direction;
  Rgb radiance;
  double density = 0;  ///< per solid angle
};

/// The light of the world around: a picture by longitude and latitude, drawn from in proportion to its brightness.
class Environment {
 public:
  /// @param light  of kind environment or sky
  explicit Environment(const Light& light);

  /// The light that comes from a direction of length 1; between pixels it is interpolated.
  Rgb radiance(const Vec3& direction) const;
  /// None where all is dark.
  std::optional<EnvironmentSample> sample(const Sample2& place) const;
  double density(const Vec3& direction) const;

  /// Whether it sends the same from everywhere. Then there is nothing to draw in proportion to.
  bool is_uniform() const { return width_ == 1 && height_ == 1; }
  /// What level white ground shows of it, or what ground that faces down does, whichever is more.
  double importance() const { return importance_; }

 private:
  struct Place {
    double column = 0, row = 0;  // in pixels
  };
  Place place_of(const Vec3& direction) const;
  Vec3 direction_of(const Place& place) const;
  const Rgb& pixel(int column, int row) const;
  void prepare_sampling();

  int width_ = 1, height_ = 1;
  std::vector<Rgb> pixels_;
  double cos_turn_ = 1, sin_turn_ = 0;
  double importance_ = 0;
  double total_ = 0;           // of the cells' brightness
  std::vector<double> rows_;   // sums of brightness before each row, and all
  std::vector<double> cells_;  // within each row: sums before each cell, and all
  double sin_row(int row) const;
};

/// The light of the sky without the sun (Preetham, Shirley, Smits, "A Practical Analytic Model for Daylight", 1999).
/// @param light  of kind sky; white level ground shows its intensity. The ground is as bright as grey ground is.
LightMap sky_map(const Light& light);

}  // namespace tenon
