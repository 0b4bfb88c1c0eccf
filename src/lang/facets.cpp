#include "lang/facets.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tenon::lang {

namespace {

// More facets than a scene can mean, and few enough to hold.
constexpr double most_facets = 10'000;

// OpenSCAD's rule for the number of fragments of a circle.
double openscad_fragments(double r, double fn, double fa, double fs) {
  // OpenSCAD's grid: what is smaller than 2^-20 gets the fewest facets.
  if (!(r >= 0x1p-20) || !std::isfinite(fn)) return 3;
  if (fn > 0) return std::max(fn, 3.0);
  // Its bounds on $fa and $fs.
  const double by_angle = 360 / std::max(fa, 0.01);
  const double by_size = r * 2 * std::numbers::pi / std::max(fs, 0.01);
  return std::ceil(std::max(std::min(by_angle, by_size), 5.0));
}

}  // namespace

int facet_count(const ModuleEvaluator& evaluator, double r) {
  const ModuleEvaluator::Names& names = evaluator.names();
  const double fn = evaluator.special_number(names.fn, 0);
  switch (evaluator.options().facets) {
    case Facets::never:
      return 0;
    case Facets::automatic:
      return fn >= 3 && fn < facets_threshold ? static_cast<int>(fn) : 0;
    case Facets::always:
      break;
  }
  const double fa = evaluator.special_number(names.fa, 12), fs = evaluator.special_number(names.fs, 2);
  return static_cast<int>(std::min(openscad_fragments(r, fn, fa, fs), most_facets));
}

std::vector<Plane> faceted_cone(double h, double r1, double r2, double bottom, int facets) {
  std::vector<Plane> planes;
  const double step = 360.0 / facets;
  // The middle of a side lies this much nearer to the axis than its corners.
  const double inward = cos_degrees(step / 2);
  const double a1 = r1 * inward, a2 = r2 * inward;
  for (int i = 0; i < facets; ++i) {
    const double angle = (i + 0.5) * step;
    const Vec3 normal{h * cos_degrees(angle), h * sin_degrees(angle), a1 - a2};
    planes.push_back({normal, h * a1 + (a1 - a2) * bottom});
  }
  if (r1 > 0) planes.push_back({{0, 0, -1}, -bottom});
  if (r2 > 0) planes.push_back({{0, 0, 1}, bottom + h});
  return planes;
}

std::vector<Vec2> sphere_profile(double r, int facets) {
  std::vector<Vec2> profile;
  const int rings = (facets + 1) / 2;
  for (int ring = rings; ring-- > 0;) {
    const double polar = 180.0 * (ring + 0.5) / rings;
    profile.push_back({r * sin_degrees(polar), r * cos_degrees(polar)});
  }
  return profile;
}

std::vector<Plane> faceted_sphere(double r, int facets) {
  const std::vector<Vec2> profile = sphere_profile(r, facets);
  const double step = 360.0 / facets;
  const double inward = cos_degrees(step / 2);
  std::vector<Plane> planes{{{0, 0, -1}, -profile.front().y}, {{0, 0, 1}, profile.back().y}};
  for (std::size_t ring = 0; ring + 1 < profile.size(); ++ring) {
    const auto [x1, z1] = profile[ring];
    const auto [x2, z2] = profile[ring + 1];
    const double a1 = x1 * inward, a2 = x2 * inward;
    for (int i = 0; i < facets; ++i) {
      const double angle = (i + 0.5) * step;
      const Vec3 normal{(z2 - z1) * cos_degrees(angle), (z2 - z1) * sin_degrees(angle), a1 - a2};
      planes.push_back({normal, (z2 - z1) * a1 + (a1 - a2) * z1});
    }
  }
  return planes;
}

}  // namespace tenon::lang
