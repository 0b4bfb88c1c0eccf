#pragma once

#include <vector>

#include "tenon/math/color.h"
#include "tenon/math/vec3.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// A material as the illumination model uses it: the factors of the course's formula with the object's colour C in.
struct Reflectance {
  Rgb ambient;             ///< ka C Ia
  Rgb diffuse;             ///< kd C
  double specular = 0;     ///< ks of the direct term
  double shininess = 0;    ///< n
  double reflected = 0;    ///< ks of the reflected ray; 0 for phong
  double transmitted = 0;  ///< kt; 0 for phong, which is opaque
};

/// What a light sends to a point.
struct IncidentLight {
  Vec3 to_light;     ///< from the point; its length is the distance where the light has a place
  double t_max = 0;  ///< along to_light: where the light stands
  Rgb light;         ///< Ij; black where the light does not reach
};

/// A light with everything that does not depend on the point worked out.
class LitLight {
 public:
  explicit LitLight(const Light& light);
  IncidentLight at(const Vec3& point) const;

 private:
  double spot_share(const Vec3& to_light) const;

  LightKind kind_;
  Vec3 position_, direction_;
  double cos_inner_, cos_outer_;  // of the spot's full light, and of its end
  Rgb emitted_;
};

/// A scene prepared for shading.
class LitScene {
 public:
  explicit LitScene(const Scene& scene);

  const Reflectance& reflectance(MaterialId id) const { return id ? materials_[id.get()] : default_material_; }
  /// The share of light that the surface returns, in whatever direction.
  Rgb albedo(const Hit& hit) const;
  const std::vector<LitLight>& lights() const { return lights_; }
  const Rgb& background() const { return background_; }
  const Rgb& ambient() const { return ambient_; }
  double ior(MediumId medium) const { return medium < medium_ior_.size() ? medium_ior_[medium] : 1.0; }

 private:
  Reflectance default_material_;
  std::vector<Reflectance> materials_;
  std::vector<LitLight> lights_;
  std::vector<double> medium_ior_;
  Rgb background_, ambient_;
};

}  // namespace tenon
