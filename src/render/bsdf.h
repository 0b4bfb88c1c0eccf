#pragma once

#include <array>
#include <cstdint>

#include "render/block.h"

namespace tenon {

/// One of the ways a surface scatters light, at each point of a block. What its kind has no use for need not be set.
struct Lobe {
  enum class Kind {
    diffuse,           ///< Lambert
    mirror,            ///< reflects
    refraction,        ///< refracts all it gets, the course's kt; reflects it under total reflection
    dielectric,        ///< reflects and refracts by Fresnel
    conductor,         ///< rough; Fresnel by Schlick from the colour
    gloss,             ///< rough; the reflection of a dielectric alone
    rough_dielectric,  ///< rough; reflects and refracts
  };

  Kind kind;
  double alpha;    ///< of rough kinds: GGX's width
  double eta;      ///< of dielectric kinds and refraction: index before the surface over that behind it
  bool is_window;  ///< where it does not bend light, shadow rays pass it as well (Surface::unbent)
  RgbBlock weight;
  NumberBlock importance;  ///< relative, of being drawn; where it is 0 the lobe does not count
  RgbBlock color;          ///< what conductors reflect straight on; the tint of what dielectrics let through
  NumberBlock lambda;      ///< of rough kinds, set by Bsdf::complete(): Smith's Lambda of where the light goes
};

/// Directions that light may have come from.
struct BsdfSamples {
  Vec3Block direction;
  RgbBlock weight;      ///< BSDF times cosine over density; black: the light is lost
  NumberBlock density;  ///< per solid angle; 0 when the direction is the only one of its kind (mirror, refraction)
  std::array<std::uint8_t, block_size> is_unbent;  ///< straight on through the surface

  /// Whether the direction lies behind the surface.
  bool is_transmitted(std::size_t i) const { return direction.z[i] < 0; }
};

/// What BSDFs send on, and how likely they would have drawn the directions.
struct BsdfValues {
  RgbBlock light;       ///< BSDF times cosine
  NumberBlock density;  ///< per solid angle
};

/// How a surface scatters light at each point of a block, seen from one direction: a sum of lobes.
///
/// Directions are local: z is the surface's normal on the viewer's side. Light is radiance: it grows by the square of
/// the index of refraction where it is refracted, but for Kind::refraction, which knows shares alone as the course
/// does.
class Bsdf {
 public:
  /// Begins anew, without lobes.
  /// @param wo     where the light goes, z > 0; outlives what is done with it
  /// @param count  of points
  void start(const Vec3Block& wo, std::size_t count);
  /// Adds a lobe that is no window, whose weight and importance, and what else its kind wants, are to be set.
  Lobe& add(Lobe::Kind kind, double alpha = 0);
  /// Ends the adding of lobes.
  void complete();

  /// The light from wi of all lobes that spread it; nothing where wi can only be met by chance.
  void evaluate(const Vec3Block& wi, BsdfValues& values) const;
  /// @param choice  in (0, 1): which lobe
  void sample(const NumberBlock& choice, const Sample2Block& place, BsdfSamples& samples) const;

  /// Whether any lobe spreads light, so that evaluate() is worth while.
  bool spreads() const { return spreads_; }
  std::size_t size() const { return size_; }

 private:
  static constexpr std::size_t most_lobes = 5;

  const Vec3Block* wo_ = nullptr;
  std::size_t size_ = 0;  // of the block, in whole vectors
  std::array<Lobe, most_lobes> lobes_;
  std::size_t count_ = 0;
  NumberBlock total_{};  // of the importances
  bool spreads_ = false;
};

}  // namespace tenon
