#pragma once

#include <optional>

#include "render/block.h"
#include "render/environment.h"
#include "render/sampler.h"
#include "tenon/math/color.h"
#include "tenon/math/ray.h"
#include "tenon/scene/light.h"

namespace tenon {

/// What a light sends to a point, when it is taken for a point itself.
struct IncidentLight {
  Vec3 to_light;     ///< from the point; its length is the distance where the light has a place
  double t_max = 0;  ///< along to_light: where the light stands
  Rgb light;         ///< Ij; black where the light does not reach
};

/// The same for many points.
struct IncidentLightBlock {
  Vec3Block to_light;
  NumberBlock t_max;
  RgbBlock light;
};

/// A direction that a light sends light from.
struct LightSample {
  Vec3 to_light;       ///< from the point; its length is the distance where the light has a place
  double t_max = 0;    ///< along to_light: where the light stands
  double cos = 1;      ///< between the direction and the normal of the light's surface
  Rgb light;           ///< radiance over density; of a light without extent, its irradiance
  double density = 0;  ///< per solid angle; 0 for a light without extent
};

/// A place on a light's surface that a ray meets.
struct LightHit {
  double t = 0;
  double cos = 1;  ///< between the ray and the normal of the light's surface
  Rgb radiance;
  double density = 0;  ///< of LightSample, had it been drawn from the ray's origin
};

/// A light with everything that does not depend on the point worked out.
class LitLight {
 public:
  /// @param environment  of a light that is around the scene; outlives this
  explicit LitLight(const Light& light, const Environment* environment = nullptr);

  /// The light as if it stood in one point: what the course's illumination model sums over. Nothing of a light that is
  /// around the scene.
  IncidentLight at(const Vec3& point) const {
    if (is_plain_point()) return {position_ - point, 1, emitted_};
    return other_at(point);
  }
  /// @param count     of points
  /// @param incident  receives it
  void at(const Vec3Block& points, std::size_t count, IncidentLightBlock& incident) const;

  /// About what a white surface at the point would show of it, shadows aside: never 0 where the light reaches, but for
  /// a uniform world, of which no direction is worth drawing.
  double importance(const Vec3& point) const { return even_importance_ ? *even_importance_ : importance_at(point); }

  /// Whether its importance is the same at every point.
  bool is_even() const { return even_importance_.has_value(); }

  /// Draws a direction to the light, by a place that only a light with extent has.
  /// @param sample  receives it
  /// @return false where none of it can be seen
  bool draw(const Vec3& point, const Sample2& place, LightSample& sample) const;

  /// Where a ray from the origin, of length 1, meets the light's surface; none for lights without one.
  std::optional<LightHit> intersect(const Ray& ray) const;

  bool has_surface() const { return kind_ == LightKind::rectangle || kind_ == LightKind::sphere; }
  /// Whether a place of it has to be drawn.
  bool has_extent() const { return has_surface() || environment_ != nullptr; }
  const Environment* environment() const { return environment_; }

 private:
  bool is_plain_point() const { return kind_ == LightKind::point && !(fade_distance_ > 0); }
  IncidentLight other_at(const Vec3& point) const;
  double importance_at(const Vec3& point) const;
  double spot_share(const Vec3& to_light) const;
  double fading(const Vec3& to_light) const;
  bool draw_other(const Vec3& point, const Sample2& place, LightSample& sample) const;
  bool draw_from_rectangle(const Vec3& point, const Sample2& place, LightSample& sample) const;
  bool draw_from_sphere(const Vec3& point, const Sample2& place, LightSample& sample) const;
  bool draw_from_environment(const Sample2& place, LightSample& sample) const;
  std::optional<LightHit> intersect_rectangle(const Ray& ray) const;
  std::optional<LightHit> intersect_sphere(const Ray& ray) const;

  LightKind kind_;
  Vec3 position_, direction_;
  double cos_inner_, cos_outer_;  // of the spot's full light, and of its end
  double fade_distance_;
  double radius_;
  Vec3 edge_u_, edge_v_;
  double area_;
  Rgb emitted_;
  const Environment* environment_;
  std::optional<double> even_importance_;  // where it is the same at every point
};

}  // namespace tenon
