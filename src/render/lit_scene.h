#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "render/ambient_light.h"
#include "render/lit_light.h"
#include "render/surface.h"
#include "tenon/math/color.h"
#include "tenon/math/vec3.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// A material as the illumination model of the course uses it: the factors of its formula. The colour C comes with the
/// place.
struct Reflectance {
  double ambient = 0;      ///< ka
  double diffuse = 0;      ///< kd
  double specular = 0;     ///< ks of the direct term
  double shininess = 0;    ///< n
  Rgb reflected;           ///< ks of the reflected ray; 0 for phong
  double transmitted = 0;  ///< kt; 0 where it is opaque
  double fresnel = 0;  ///< the share that is reflected beside `reflected`, by Fresnel; the rest of it is transmitted
  double ior = 1;      ///< of the material, for Fresnel where it is opaque

  /// Whether rays go on from here.
  bool sends_on() const { return reflected != Rgb{} || transmitted > 0 || fresnel > 0; }
};

/// A light that is drawn among all.
struct LightChoice {
  const LitLight* light = nullptr;
  double probability = 0;
};

/// A scene prepared for shading.
class LitScene {
 public:
  explicit LitScene(const Scene& scene);

  /// @name Surfaces
  /// @{
  const Reflectance& reflectance(MaterialId id) const { return prepared(id).reflectance; }
  const Surface& surface(MaterialId id) const { return prepared(id).surface; }
  /// The colour of the material where the hit is, linear.
  Rgb color(const Hit& hit) const {
    const Prepared& material = prepared(hit.material);
    return material.texture.kind == TextureKind::none ? material.color : textured_color(material, hit);
  }
  /// What the surface sends out by itself.
  Rgb emitted(const Hit& hit) const {
    const double emission = prepared(hit.material).emission;
    return emission > 0 ? emission * color(hit) : Rgb{};
  }
  /// The share of light that the surface returns, in whatever direction.
  Rgb albedo(const Hit& hit) const;
  /// @}

  /// @name Media
  /// @{
  double ior(MediumId medium) const { return medium < media_.size() ? media_[medium].ior : 1.0; }
  Boundary boundary(const Hit& hit) const;
  /// What is left of light on its way through a medium.
  Rgb attenuation(MediumId medium, double length) const {
    const bool is_clear = medium <= medium_opaque || medium >= media_.size();
    return is_clear ? Rgb{1, 1, 1} : attenuation_inside(medium, length);
  }
  /// Whether light may go straight on through some boundary.
  bool has_unbent() const { return has_unbent_; }
  /// Whether some material lets light through at all.
  bool has_transmission() const { return has_transmission_; }
  /// @}

  /// @name Lights
  /// @{
  const std::vector<LitLight>& lights() const { return lights_; }
  /// What white matt surfaces show of light from everywhere, shadows aside: that of the world around where the scene
  /// names it.
  /// @param normal  on the viewer's side
  Rgb ambient(const Vec3& normal) const { return ambient_light_ ? (*ambient_light_)(normal) : ambient_; }
  const Rgb& background() const { return background_; }
  /// The world around, when the scene names it.
  const LitLight* around() const { return around_; }
  /// Whether a place has to be drawn of some light that choose_light() may draw.
  bool draws_places_of_lights() const { return draws_places_of_lights_; }
  /// What a ray shows that meets nothing.
  /// @param is_camera_ray  nothing has bent it since it left the camera
  /// @param is_sharp       nothing has spread it since then: it met mirrors and clear glass alone
  Rgb beyond(const Vec3& direction, bool is_camera_ray, bool is_sharp) const;

  /// Draws a light in proportion to what reaches a point, shadows aside; lights of a uniform world are not drawn.
  LightChoice choose_light(const Vec3& point, double choice) const;
  /// The probability of that light in choose_light().
  double choice_probability(const LitLight& light, const Vec3& point) const;

  /// The nearest surface of a light that a ray meets.
  /// @param ray    of length 1
  /// @param t_max  light that lies in a solid's face there counts as before it
  std::optional<std::pair<const LitLight*, LightHit>> first_light(const Ray& ray, double t_max) const {
    if (!has_light_surfaces_) return std::nullopt;
    return first_of_light_surfaces(ray, t_max);
  }
  /// Whether a light other than `to` stands in the way. The ray need not have length 1.
  bool is_blocked_by_light(const Ray& ray, double t_max, const LitLight* to) const {
    return has_light_surfaces_ && is_blocked_by_light_surface(ray, t_max, to);
  }
  /// How far before a light's surface solids may lie that count as lying in it.
  /// @param cos  between the ray and the surface's normal
  double light_margin(double cos) const { return margin_ / cos; }
  /// @}

 private:
  struct Prepared {
    Rgb color, second;
    SolidTexture texture;
    double emission;
    Reflectance reflectance;
    Surface surface;
  };

  Rgb attenuation_inside(MediumId medium, double length) const;
  Rgb textured_color(const Prepared& material, const Hit& hit) const;
  double importance_of_all(const Vec3& point) const;
  std::optional<std::pair<const LitLight*, LightHit>> first_of_light_surfaces(const Ray& ray, double t_max) const;
  bool is_blocked_by_light_surface(const Ray& ray, double t_max, const LitLight* to) const;
  const Prepared& prepared(MaterialId id) const { return materials_[id ? id.get() + 1 : 0]; }
  Prepared prepare(const Material& material);
  void prepare_lights(const Scene& scene);

  std::vector<Prepared> materials_;  // the default one, then those of the scene
  std::vector<Medium> media_;
  bool has_unbent_ = false, has_transmission_ = false;
  std::vector<LitLight> lights_;
  std::optional<double> even_importance_;  // of all lights, where it is the same at every point
  std::deque<Environment> environments_;
  const LitLight* around_ = nullptr;
  bool has_light_surfaces_ = false, draws_places_of_lights_ = false;
  double margin_ = 0;
  Rgb background_, ambient_;
  std::optional<AmbientLight> ambient_light_;  // of the world around
  bool shows_around_ = false;
};

}  // namespace tenon
