#include "render/section_hatch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tenon/math/affine3.h"

namespace tenon {

namespace {

// What is left of the light under a line.
constexpr double ink = 0.45;
// The width of a line, in spacings.
constexpr double line_width = 0.14;
constexpr double spacings_across_the_solid = 70;

// A style for each material, against the first one's: neighbours are told apart by the slope, then by the spacing.
struct Style {
  double turn, spacing;
};
constexpr std::array<Style, 8> styles{
    {{0, 1}, {90, 1}, {0, 0.6}, {90, 0.6}, {-15, 1.5}, {105, 1.5}, {20, 0.8}, {70, 0.8}}};

double automatic_spacing(const Scene& scene) {
  const Box3 bounds = scene_figures(scene).bounds;
  const double size = bounds.is_bounded() ? length(bounds.size()) : length(scene.camera.from - scene.camera.at);
  return size / spacings_across_the_solid;
}

// How much of the lines lies before a place: of each spacing the first part.
double lines_before(double place) {
  const double whole = std::floor(place);
  return whole * line_width + std::min(place - whole, line_width);
}

}  // namespace

SectionHatch::SectionHatch(const Scene& scene, const CameraRays& camera, const HatchOptions& options, int samples)
    : camera_(camera),
      first_plane_(scene.first_section_plane),
      options_(options),
      sharpness_(1 / std::sqrt(static_cast<double>(samples))) {
  if (!(options_.spacing > 0)) {
    options_.spacing = automatic_spacing(scene);
    options_.in_pixels = false;
  }
}

double SectionHatch::light(const Hit& hit, const PicturePlace& at) const {
  // LeafId{} is larger than every leaf: without a section no face is cut.
  if (!hit.found() || hit.surface.leaf < first_plane_) return 1;
  const Style& style = styles[hit.material ? (hit.material.get() + 1) % styles.size() : 0];
  const double angle = options_.angle + style.turn, spacing = options_.spacing * style.spacing;
  const Across across = options_.in_pixels ? in_picture(angle, spacing, at) : in_plane(hit, angle, spacing, at);
  // The mean over the stretch that the sample stands for (a box filter), so lines have smooth edges at any distance.
  const double half = 0.5 * sharpness_ * across.per_pixel;
  if (!(half > 0)) return 1;
  const double covered = (lines_before(across.place + half) - lines_before(across.place - half)) / (2 * half);
  return 1 - (1 - ink) * std::clamp(covered, 0.0, 1.0);
}

SectionHatch::Across SectionHatch::in_picture(double angle, double spacing, const PicturePlace& at) const {
  // y grows downward in pictures.
  return {(-sin_degrees(angle) * at.x - cos_degrees(angle) * at.y) / spacing, 1 / spacing};
}

SectionHatch::Across SectionHatch::in_plane(const Hit& hit, double angle, double spacing,
                                            const PicturePlace& at) const {
  const Vec3& n = hit.normal;
  const ScreenView& view = camera_.view();
  // The picture's horizontal, laid into the plane.
  Vec3 level = view.right - dot(n, view.right) * n;
  if (level == Vec3{}) level = view.up - dot(n, view.up) * n;
  level = normalize(level);
  const Vec3 upward = dot(cross(n, level), view.up) < 0 ? -cross(n, level) : cross(n, level);
  const Vec3 direction = (-sin_degrees(angle) * level + cos_degrees(angle) * upward) / spacing;
  const auto place_at = [&](double px, double py) {
    const Ray ray = camera_.ray(px, py);
    const double t = dot(n, hit.point - ray.origin) / dot(n, ray.direction);
    return dot(direction, ray.at(t));
  };
  const double here = place_at(at.x, at.y);
  return {dot(direction, hit.point), std::hypot(place_at(at.x + 1, at.y) - here, place_at(at.x, at.y + 1) - here)};
}

}  // namespace tenon
