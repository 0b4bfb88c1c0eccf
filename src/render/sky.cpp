#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "render/environment.h"

namespace tenon {

namespace {

constexpr double pi = std::numbers::pi;

// Perez's distribution of the luminance, or of a chromaticity, over the sky; a to e are linear in the turbidity.
struct Perez {
  std::array<double, 5> at_zero_turbidity, per_turbidity;

  double operator()(double turbidity, double cos_zenith, double sun_angle) const {
    std::array<double, 5> k{};
    for (std::size_t i = 0; i < k.size(); ++i) k[i] = at_zero_turbidity[i] + per_turbidity[i] * turbidity;
    const double cos_sun = std::cos(sun_angle);
    return (1 + k[0] * std::exp(k[1] / cos_zenith)) *
           (1 + k[2] * std::exp(k[3] * sun_angle) + k[4] * cos_sun * cos_sun);
  }
};

// Preetham et al. 1999, appendix 2.
constexpr Perez luminance{{-1.4630, 0.4275, 5.3251, -2.5771, 0.3703}, {0.1787, -0.3554, -0.0227, 0.1206, -0.0670}};
constexpr Perez chromaticity_x{{-0.2592, 0.0008, 0.2125, -0.8989, 0.0452},
                               {-0.0193, -0.0665, -0.0004, -0.0641, -0.0033}};
constexpr Perez chromaticity_y{{-0.2608, 0.0092, 0.2102, -1.6537, 0.0529},
                               {-0.0167, -0.0950, -0.0079, -0.0441, -0.0109}};

using Cubic = std::array<double, 4>;
double cubic(const Cubic& c, double x) {
  return ((c[0] * x + c[1]) * x + c[2]) * x + c[3];
}
// By turbidity squared, turbidity and 1: cubics of the sun's angle from the zenith.
double zenith(const std::array<Cubic, 3>& c, double turbidity, double sun) {
  return (cubic(c[0], sun) * turbidity + cubic(c[1], sun)) * turbidity + cubic(c[2], sun);
}
constexpr std::array<Cubic, 3> zenith_x{
    {{0.00166, -0.00375, 0.00209, 0}, {-0.02903, 0.06377, -0.03202, 0.00394}, {0.11693, -0.21196, 0.06052, 0.25886}}};
constexpr std::array<Cubic, 3> zenith_y{
    {{0.00275, -0.00610, 0.00317, 0}, {-0.04214, 0.08970, -0.04153, 0.00516}, {0.15346, -0.26756, 0.06670, 0.26688}}};

Rgb rgb_of(double luminance_there, double x, double y) {
  const double scale = luminance_there / y;
  const double big_x = scale * x, big_y = luminance_there, big_z = scale * (1 - x - y);
  // Linear sRGB of CIE XYZ (IEC 61966-2-1); what lies outside of it is clipped.
  return {std::max(0.0, 3.2406 * big_x - 1.5372 * big_y - 0.4986 * big_z),
          std::max(0.0, -0.9689 * big_x + 1.8758 * big_y + 0.0415 * big_z),
          std::max(0.0, 0.0557 * big_x - 0.2040 * big_y + 1.0570 * big_z)};
}

}  // namespace

LightMap sky_map(const Light& light) {
  const double turbidity = light.turbidity;
  Vec3 to_sun = normalize(-light.direction);
  to_sun.z = std::max(to_sun.z, 0.0);  // below the horizon the model ends
  to_sun = normalize(to_sun);
  const double sun = std::acos(std::clamp(to_sun.z, -1.0, 1.0));
  const double x0 = zenith(zenith_x, turbidity, sun), y0 = zenith(zenith_y, turbidity, sun);

  LightMap map;
  map.width = 256;
  map.height = 128;
  std::vector<Rgb> pixels;
  Rgb irradiance;
  for (int row = 0; row < map.height / 2; ++row) {
    const double colatitude = pi * (row + 0.5) / map.height;
    const double solid_angle = std::sin(colatitude) * (pi / map.height) * (2 * pi / map.width);
    for (int column = 0; column < map.width; ++column) {
      const double longitude = ((column + 0.5) / map.width - 0.5) * (2 * pi);
      const Vec3 d{std::sin(colatitude) * std::sin(longitude), std::sin(colatitude) * std::cos(longitude),
                   std::cos(colatitude)};
      const double sun_angle = std::acos(std::clamp(dot(d, to_sun), -1.0, 1.0));
      const auto relative = [&](const Perez& perez) {
        return perez(turbidity, d.z, sun_angle) / perez(turbidity, 1, sun);
      };
      const Rgb there = rgb_of(relative(luminance), x0 * relative(chromaticity_x), y0 * relative(chromaticity_y));
      pixels.push_back(there);
      irradiance += (solid_angle * d.z) * there;
    }
  }
  constexpr double ground_albedo = 0.3;
  const Rgb ground = (ground_albedo / pi) * irradiance;
  pixels.resize(2 * pixels.size(), ground);
  const double shown = (0.2126 * irradiance.r + 0.7152 * irradiance.g + 0.0722 * irradiance.b) / pi;
  const Rgb factor = (light.intensity / shown) * linear_from_srgb(light.color);
  for (const Rgb& p : pixels) {
    const Rgb scaled = factor * p;
    for (const double band : {scaled.r, scaled.g, scaled.b}) map.rgb.push_back(static_cast<float>(band));
  }
  return map;
}

}  // namespace tenon
