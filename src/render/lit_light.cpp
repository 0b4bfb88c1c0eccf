#include "render/lit_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "math/quarter_turns.h"
#include "render/sphere_sampling.h"
#include "tenon/math/affine3.h"

namespace tenon {

namespace {

constexpr double inf = std::numeric_limits<double>::infinity();
constexpr double pi = std::numbers::pi;

double largest(const Rgb& c) {
  return std::max({c.r, c.g, c.b});
}

// The angle that a sphere fills, as 1 - cos of its half; without cancellation where it is small.
double one_minus_cos(double sin_squared) {
  return sin_squared / (1 + std::sqrt(std::max(0.0, 1 - sin_squared)));
}

}  // namespace

LitLight::LitLight(const Light& light, const Environment* environment)
    : kind_(light.kind),
      position_(light.position),
      direction_(normalize(light.direction)),
      cos_inner_(cos_degrees(light.angle * (1 - light.softness))),
      cos_outer_(cos_degrees(light.angle)),
      fade_distance_(light.fade_distance),
      radius_(light.radius),
      edge_u_(light.edge_u),
      edge_v_(light.edge_v),
      area_(length(cross(light.edge_u, light.edge_v))),
      emitted_(light.intensity * linear_from_srgb(light.color)),
      environment_(environment) {
  const bool is_even = environment_ != nullptr || kind_ == LightKind::directional || is_plain_point();
  if (is_even) even_importance_ = importance_at(position_);
}

void LitLight::at(const Vec3Block& points, std::size_t count, IncidentLightBlock& incident) const {
  if (is_plain_point()) {
    for (std::size_t i = 0; i < count; ++i) incident.to_light.set(i, position_ - points[i]);
    for (std::size_t i = 0; i < count; ++i) incident.t_max[i] = 1;
    for (std::size_t i = 0; i < count; ++i) incident.light.set(i, emitted_);
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const IncidentLight one = other_at(points[i]);
    incident.to_light.set(i, one.to_light);
    incident.t_max[i] = one.t_max;
    incident.light.set(i, one.light);
  }
}

IncidentLight LitLight::other_at(const Vec3& point) const {
  if (kind_ == LightKind::directional) return {-direction_, inf, emitted_};
  const Vec3 to_light = position_ - point;
  const double squared = dot(to_light, to_light);
  switch (kind_) {
    case LightKind::point:
      return {to_light, 1, fading(to_light) * emitted_};
    case LightKind::spot:
      return {to_light, 1, (fading(to_light) * spot_share(to_light)) * emitted_};
    case LightKind::sphere:
      // Up to its surface, where it sends as much as it is bright.
      return {to_light, 1, std::min(1.0, radius_ * radius_ / squared) * emitted_};
    case LightKind::rectangle: {
      const double cos = -dot(normalize(to_light), direction_);
      return {to_light, 1, (cos > 0 ? std::min(1.0, cos * area_ / (pi * squared)) : 0) * emitted_};
    }
    default:
      return {};
  }
}

// 1 in the inner cone, 0 outside the outer one; between them the smooth step, which has no visible edge.
double LitLight::spot_share(const Vec3& to_light) const {
  const double cos_angle = -dot(normalize(to_light), direction_);
  if (cos_angle >= cos_inner_) return 1;
  if (cos_angle <= cos_outer_) return 0;
  const double x = (cos_angle - cos_outer_) / (cos_inner_ - cos_outer_);
  return x * x * (3 - 2 * x);
}

double LitLight::fading(const Vec3& to_light) const {
  if (!(fade_distance_ > 0)) return 1;
  return fade_distance_ * fade_distance_ / dot(to_light, to_light);
}

double LitLight::importance_at(const Vec3& point) const {
  if (environment_ != nullptr) return environment_->is_uniform() ? 0 : environment_->importance();
  if (kind_ != LightKind::rectangle) return largest(at(point).light);
  // Near the light its middle says little about how much of it there is to see, and from which side.
  if (!(dot(point - position_, direction_) > 0)) return 0;
  const Vec3 to_light = position_ - point;
  return largest(emitted_) * std::min(1.0, area_ / (pi * dot(to_light, to_light)));
}

// Part by part, where it stays: a copy of what was just put together waits for all of its parts.
bool LitLight::draw(const Vec3& point, const Sample2& place, LightSample& sample) const {
  if (has_surface() || environment_ != nullptr) return draw_other(point, place, sample);
  const IncidentLight incident = at(point);
  sample.to_light = incident.to_light;
  sample.t_max = incident.t_max;
  sample.cos = 1;
  sample.light = pi * incident.light;
  sample.density = 0;
  return incident.light != Rgb{};
}

bool LitLight::draw_other(const Vec3& point, const Sample2& place, LightSample& sample) const {
  if (kind_ == LightKind::rectangle) return draw_from_rectangle(point, place, sample);
  if (kind_ == LightKind::sphere) return draw_from_sphere(point, place, sample);
  return draw_from_environment(place, sample);
}

bool LitLight::draw_from_rectangle(const Vec3& point, const Sample2& place, LightSample& sample) const {
  sample.to_light = position_ + (place.u - 0.5) * edge_u_ + (place.v - 0.5) * edge_v_ - point;
  sample.t_max = 1;
  const double squared = dot(sample.to_light, sample.to_light);
  sample.cos = -dot(sample.to_light, direction_) / std::sqrt(squared);
  if (!(sample.cos > 0)) return false;
  sample.density = squared / (sample.cos * area_);
  sample.light = emitted_ * (1 / sample.density);
  return true;
}

// Evenly over the cone that the sphere fills.
bool LitLight::draw_from_sphere(const Vec3& point, const Sample2& place, LightSample& sample) const {
  const Vec3 to_center = position_ - point;
  const double distance = length(to_center), sin_squared = radius_ * radius_ / (distance * distance);
  if (!(sin_squared < 1)) return false;
  const double away = place.u * one_minus_cos(sin_squared);  // 1 - cos of the angle from the centre
  const double sin = std::sqrt(away * (2 - away));
  const SineCosine around = quarter_turn_sine_cosine(4 * place.v);
  const Vec3 direction = Frame(to_center / distance).to_world({sin * around.cosine, sin * around.sine, 1 - away});
  const double from_axis = distance * sin;
  const double half_chord = std::sqrt(std::max(0.0, radius_ * radius_ - from_axis * from_axis));
  sample.to_light = (distance * (1 - away) - half_chord) * direction;
  sample.t_max = 1;
  sample.cos = half_chord / radius_;
  sample.density = 1 / (2 * pi * one_minus_cos(sin_squared));
  sample.light = emitted_ * (1 / sample.density);
  return true;
}

bool LitLight::draw_from_environment(const Sample2& place, LightSample& sample) const {
  const auto drawn = environment_->sample(place);
  if (!drawn) return false;
  sample.to_light = drawn->direction;
  sample.t_max = inf;
  sample.cos = 1;
  sample.density = drawn->density;
  sample.light = drawn->radiance * (1 / drawn->density);
  return true;
}

std::optional<LightHit> LitLight::intersect(const Ray& ray) const {
  if (kind_ == LightKind::rectangle) return intersect_rectangle(ray);
  if (kind_ == LightKind::sphere) return intersect_sphere(ray);
  return std::nullopt;
}

std::optional<LightHit> LitLight::intersect_rectangle(const Ray& ray) const {
  const double cos = -dot(ray.direction, direction_);
  if (!(cos > 0)) return std::nullopt;
  const double t = dot(ray.origin - position_, direction_) / cos;
  if (!(t > 0)) return std::nullopt;
  // The place as shares of the sides, by Cramer's rule in the plane.
  const Vec3 across = ray.at(t) - position_;
  const Vec3 normal = cross(edge_u_, edge_v_);
  const double u = dot(cross(across, edge_v_), normal), v = dot(cross(edge_u_, across), normal);
  if (std::max(std::fabs(u), std::fabs(v)) > 0.5 * area_ * area_) return std::nullopt;
  return LightHit{t, cos, emitted_, t * t / (cos * area_)};
}

std::optional<LightHit> LitLight::intersect_sphere(const Ray& ray) const {
  const Vec3 to_center = position_ - ray.origin;
  const double squared = dot(to_center, to_center), sin_squared = radius_ * radius_ / squared;
  const double along = dot(to_center, ray.direction);
  if (!(sin_squared < 1) || !(along > 0)) return std::nullopt;
  const Vec3 off = to_center - along * ray.direction;
  const double chord_squared = radius_ * radius_ - dot(off, off);
  if (!(chord_squared > 0)) return std::nullopt;
  const double half_chord = std::sqrt(chord_squared);
  return LightHit{along - half_chord, half_chord / radius_, emitted_, 1 / (2 * pi * one_minus_cos(sin_squared))};
}

}  // namespace tenon
