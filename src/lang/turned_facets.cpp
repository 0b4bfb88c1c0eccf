#include "lang/turned_facets.h"

#include <algorithm>
#include <cmath>

#include "lang/failure.h"
#include "lang/polyhedron.h"
#include "plane/shape.h"

namespace tenon::lang {

namespace {

constexpr std::size_t most_corners = 1'000'000;

}  // namespace

std::vector<double> facet_angles(int facets, double degrees) {
  const bool is_whole = std::fabs(degrees) >= 360;
  const double turn = is_whole ? 360 : degrees;
  // A facet of half a circle would go through the axis.
  const int fewest = static_cast<int>(std::fabs(turn) / 180) + 1;
  const int count = std::max(facets, fewest);
  std::vector<double> angles;
  for (int i = 0; i < count; ++i) angles.push_back((is_whole ? 180 : 0) + turn * i / count);
  if (is_whole) return angles;
  const double rest = std::copysign(360, turn) - turn;
  const int more = static_cast<int>(std::fabs(rest) / 180) + 1;
  for (int i = 0; i < more; ++i) angles.push_back(turn + rest * i / more);
  if (turn < 0) std::reverse(angles.begin(), angles.end());
  return angles;
}

Solid turned_in_facets(ModuleEvaluator& evaluator, const Outline& outline, double on_axis,
                       const std::vector<double>& angles, Place at) {
  std::vector<Vec3> points;
  std::vector<std::vector<std::size_t>> faces;
  // Loops turn to the left around what they enclose.
  for (auto& loop : resolve(Shape::of(outline)).loops) {
    for (OutlineCorner& corner : loop) corner.x = corner.x <= on_axis ? 0 : corner.x;
    if (points.size() + loop.size() * angles.size() > most_corners) {
      fail(at, "more than a million corners of facets come of this; give a smaller $fn, or larger $fa and $fs");
    }
    const std::size_t first = points.size(), corners = loop.size(), copies = angles.size();
    for (const double angle : angles) {
      const double c = cos_degrees(angle), s = sin_degrees(angle);
      for (const OutlineCorner& corner : loop) points.push_back({corner.x * c, corner.x * s, corner.y});
    }
    // All copies of a point of the axis are one.
    const auto point = [&](std::size_t copy, std::size_t corner) {
      return first + (loop[corner].x == 0 ? 0 : copy * corners) + corner;
    };
    for (std::size_t i = 0; i < copies; ++i) {
      const std::size_t next = (i + 1) % copies;
      for (std::size_t k = 0; k < corners; ++k) {
        const std::size_t l = (k + 1) % corners;
        const bool starts_on_axis = loop[k].x == 0, ends_on_axis = loop[l].x == 0;
        if (starts_on_axis && ends_on_axis) continue;
        std::vector<std::size_t> face{point(i, k)};
        if (!starts_on_axis) face.push_back(point(next, k));
        face.push_back(point(next, l));
        if (!ends_on_axis) face.push_back(point(i, l));
        faces.push_back(std::move(face));
      }
    }
  }
  return faces.empty() ? Solid::nothing() : polyhedron_solid(evaluator, points, faces, at);
}

}  // namespace tenon::lang
