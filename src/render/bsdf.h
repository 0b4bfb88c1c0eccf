#pragma once

#include <array>
#include <optional>

#include "render/albedo_table.h"
#include "render/sampler.h"
#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// One of the ways a surface scatters light. What its kind has no use for need not be set.
struct Lobe {
  enum class Kind {
    diffuse,           ///< Lambert
    mirror,            ///< reflects
    refraction,        ///< refracts all it gets, the course's kt; reflects it under total reflection
    dielectric,        ///< reflects and refracts by Fresnel
    conductor,         ///< rough; Fresnel by Schlick from f0
    gloss,             ///< rough; the reflection of a dielectric alone
    rough_dielectric,  ///< rough; reflects and refracts
  };

  Kind kind;
  Rgb weight;
  double probability;  ///< of being drawn
  double alpha;        ///< of rough kinds: GGX's width
  double eta;          ///< of dielectric kinds and refraction: index before the surface over that behind it
  double scale;        ///< of rough kinds: makes up for what single scattering loses
  double lambda;       ///< of rough kinds: Smith's Lambda of where the light goes
  Rgb f0;              ///< of conductors
  Rgb tint;            ///< of what dielectrics let through
  bool is_window;      ///< where it does not bend light, shadow rays pass it as well (Surface::unbent)
};

/// A direction that light may have come from.
struct BsdfSample {
  Vec3 direction;
  Rgb weight;          ///< BSDF times cosine over density
  double density = 0;  ///< per solid angle; 0 when the direction is the only one of its kind (mirror, refraction)
  bool is_transmitted = false;  ///< the direction lies behind the surface
  bool is_unbent = false;       ///< straight on through the surface
};

/// What a BSDF sends on, and how likely it would have drawn the direction.
struct BsdfValue {
  Rgb light;           ///< BSDF times cosine
  double density = 0;  ///< per solid angle
};

/// How a surface scatters light at one point, seen from one direction: a sum of lobes.
///
/// Directions are local: z is the surface's normal on the viewer's side. Light is radiance: it grows by the square of
/// the index of refraction where it is refracted, but for Kind::refraction, which knows shares alone as the course
/// does.
class Bsdf {
 public:
  /// @param wo  where the light goes, z > 0
  explicit Bsdf(const Vec3& wo) : wo_(wo) {}

  /// Adds a lobe that shows its microfacets' width (0: it has none), and neither scales nor is a window.
  /// @param importance  relative, of the lobe's being drawn
  /// @return where the kind's other parameters go; null: a lobe of no importance is left out
  Lobe* add(Lobe::Kind kind, const Rgb& weight, double importance, double alpha = 0);

  /// The light from wi of all lobes that spread it; nothing when wi can only be met by chance.
  BsdfValue evaluate(const Vec3& wi) const;
  /// @param choice  in (0, 1): which lobe
  /// @return none: the light is lost
  std::optional<BsdfSample> sample(double choice, const Sample2& place) const;

  /// Whether any lobe spreads light, so that evaluate() is worth while.
  bool spreads() const { return spreads_; }

 private:
  static constexpr std::size_t most_lobes = 5;

  Vec3 wo_;
  std::array<Lobe, most_lobes> lobes_;  // not set from count_ on
  std::size_t count_ = 0;
  double total_ = 0;  // of the importances
  bool spreads_ = false;
};

}  // namespace tenon
