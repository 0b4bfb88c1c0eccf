#pragma once

#include <algorithm>
#include <vector>

#include "render/lit_scene.h"

namespace tenon {

/// What becomes of light that goes straight on through boundaries and media. A structure may report the boundaries in
/// any order; the product is the same to the last bit.
class PassedBoundaries {
 public:
  void clear() { passed_.clear(); }
  /// @param share  of the light that the boundary lets through
  void add(const Hit& hit, const Rgb& share) { passed_.push_back({hit.t, share, hit.before, hit.after}); }

  /// @param start            the medium where the way begins
  /// @param length_per_unit  of the ray's parameter
  /// @param t_max            where the way ends; may be infinite
  Rgb left(const LitScene& scene, MediumId start, double length_per_unit, double t_max) {
    std::sort(passed_.begin(), passed_.end(),
              [](const Passed& a, const Passed& b) { return a.t != b.t ? a.t < b.t : a.before < b.before; });
    Rgb product{1, 1, 1};
    double t = 0;
    MediumId medium = start;
    for (const Passed& p : passed_) {
      product = p.share * product * scene.attenuation(p.before, (p.t - t) * length_per_unit);
      t = p.t;
      medium = p.after;
    }
    return product * scene.attenuation(medium, (t_max - t) * length_per_unit);
  }

 private:
  struct Passed {
    double t;
    Rgb share;
    MediumId before, after;
  };
  std::vector<Passed> passed_;
};

}  // namespace tenon
