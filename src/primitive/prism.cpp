#include "primitive/prism.h"

#include <algorithm>
#include <cmath>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/prism_line.h"
#include "primitive/wedge.h"
#include "tenon/math/rounding.h"

namespace tenon {

std::string Prism::check() const {
  if (std::string problem = check_outline(name, outline); !problem.empty()) return problem;
  return check_lengths(name, {{"h", h}, {"scale", scale, true}});
}

void Prism::spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const {
  Chord slab;
  if (!clip_slab(ray, 2, low(), high(), bottom, top, slab)) return;
  Line line(*this, ray);
  if (!line.find_part(edges_, slab)) return;

  // A line that runs from cap to cap and moves across less than its own error is inside or outside as a whole.
  const bool from_cap_to_cap = std::isfinite(slab.enter.t) && std::isfinite(slab.leave.t) &&
                               !line.part().outside_before && !line.part().outside_after;
  const double blur = from_cap_to_cap ? line.blur() : -1;
  if (blur >= 0) {
    const Vec2 place = line.at(0.5 * line.part().begin + 0.5 * line.part().end);
    if (edges_.contains(place) || edges_.is_near_edge(place, blur)) emit_chord(slab, out);
    return;
  }

  const SearchedPart part = line.part().within(window);
  if (part.is_empty()) return;
  thread_local std::vector<EdgeCrossing> crossings;
  thread_local std::vector<BoundaryCrossing> boundary;
  line.cross_edges(edges_, window, crossings);
  const auto is_inside = [&](double t) {
    return line.is_before_tip(t) && (line.lies_in_segment(t) || edges_.contains(line.at(t)));
  };
  const bool inside = find_boundary_crossings(crossings, part, is_inside, boundary);
  emit_between_caps(slab, boundary, inside, walls, out);
}

std::optional<Crossing> Prism::crossing_near(const LocalRay& ray, double t, double near, bool entering) const {
  Chord slab;
  if (!clip_slab(ray, 2, low(), high(), bottom, top, slab)) return std::nullopt;
  Line line(*this, ray);
  if (!line.find_part(edges_, slab) || line.blur() >= 0) return std::nullopt;
  // Whatever may be one with a crossing there, if that is known to within `near`.
  thread_local std::vector<EdgeCrossing> crossings;
  line.cross_edges(edges_, {t - 2 * near, t + 2 * near}, crossings);
  return crossing_between_caps(slab, crossings, t, near, entering, walls);
}

namespace {

// The part of the plane that a box covers, divided by the scales between its ends.
void divide(double lower, double upper, double s_least, double s_most, double& low, double& high) {
  low = (lower < 0 ? lower / s_least : lower / s_most) * (1 - std::copysign(gamma(2), lower));
  high = (upper < 0 ? upper / s_most : upper / s_least) * (1 + std::copysign(gamma(2), upper));
}

}  // namespace

// Whether n·((x, y) - v s(z)) is certainly positive over a box.
bool Prism::lies_beyond(const LocalBox& box, const Vec2& n, const Vec2& v) const {
  const double k = scale == 1 ? 0 : slope(), c = dot(n, v);
  const Extent extent = extent_along(box, {n.x, n.y, -c * k});
  const double size = std::fabs(n.x * v.x) + std::fabs(n.y * v.y);
  return extent.least() - c * (1 - low() * k) >
         gamma(16) * size * (1 + (std::fabs(low()) + reach(box).z) * std::fabs(k));
}

// False where a box certainly does not touch the wall over an edge.
bool Prism::may_touch(const LocalBox& box, const OutlineEdge& edge) const {
  const Vec2 w = edge.chord(), right{w.y, -w.x};
  if (!edge.is_arc()) {
    return !(lies_beyond(box, right, edge.from) || lies_beyond(box, -1 * right, edge.from) ||
             lies_beyond(box, -1 * w, edge.from) || lies_beyond(box, w, edge.to));
  }
  if (lies_beyond(box, edge.bulge > 0 ? -1 * right : right, edge.from)) return false;
  // q of a point relative to the moved corner, p = (x, y) - from s(z), is q(p, s) = bulge p·(p - w s) - flatness
  // cross(w, p) s. Its value in the middle, its change along the half edges, and the most that its second order can
  // add.
  const double k = scale == 1 ? 0 : slope(), s = scale_at(box.center.z);
  const double b = edge.bulge, flat = edge.flatness();
  const Vec2 p = Vec2{box.center.x, box.center.y} - s * edge.from;
  double first_order = 0, moved = 0, s_moved = 0;
  const auto move = [&](const Vec3& way) {
    const Vec2 d = Vec2{way.x, way.y} - (k * way.z) * edge.from;
    first_order +=
        std::fabs(dot(b * (2 * p - s * w) + (flat * s) * right, d) - (b * dot(p, w) + flat * cross(w, p)) * k * way.z);
    moved += length(d);
    s_moved += std::fabs(k * way.z);
  };
  for (const Vec3& half_edge : box.half_edges) move(half_edge);
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 e;
    e[axis] = box.error[axis];
    move(e);
  }
  const double w_length = length(w), ab = std::fabs(b), af = std::fabs(flat);
  const double second_order = ab * moved * (moved + w_length * s_moved) + af * w_length * moved * s_moved;
  const double size = length(p) + moved + length(edge.from) * (1 + s_moved), s_size = std::fabs(s) + s_moved + 1;
  const double rounding = gamma(32) * (ab * size * (size + w_length * s_size) + af * w_length * size * s_size);
  return std::fabs(b * dot(p, p - s * w) - flat * cross(w, p) * s) <= first_order + second_order + rounding;
}

// Calls visit(index of an edge) for those over which a box may touch the wall, until it returns false.
template <class Visit>
bool Prism::visit_walls(const LocalBox& box, double least_scale, double most_scale, const Visit& visit) const {
  Vec2 lower, upper;
  divide(box.bounds.lower.x, box.bounds.upper.x, least_scale, most_scale, lower.x, upper.x);
  divide(box.bounds.lower.y, box.bounds.upper.y, least_scale, most_scale, lower.y, upper.y);
  const auto overlaps = [&](const Vec2& a, const Vec2& b) {
    return a.x <= upper.x && lower.x <= b.x && a.y <= upper.y && lower.y <= b.y;
  };
  return edges_.visit_edges(overlaps, [&](std::uint32_t i) { return !may_touch(box, edges_.edges()[i]) || visit(i); });
}

Region Prism::classify(const LocalBox& box) const {
  if (box.bounds.upper.z < low() || box.bounds.lower.z > high()) return Region::outside;
  // What matters is what lies between the caps.
  const double s1 = scale_at(std::max(box.bounds.lower.z, low())), s2 = scale_at(std::min(box.bounds.upper.z, high()));
  const double slack = scale == 1 ? 0 : gamma(8) * (1 + scale);
  const double s_least = std::min(s1, s2) - slack, s_most = std::max(s1, s2) + slack;
  if (!(s_least > 0)) return Region::straddles;
  const bool clear = visit_walls(box, s_least, s_most, [](std::uint32_t) { return false; });
  if (!clear) return Region::straddles;
  // No wall goes through the box: what of it lies between the caps is inside as a whole, or outside.
  const Vec3 place = point_between_caps(box);
  const double s = scale_at(place.z);
  if (!edges_.contains({place.x / s, place.y / s})) return Region::outside;
  const bool between_caps = box.bounds.lower.z >= low() && box.bounds.upper.z <= high();
  return between_caps ? Region::inside : Region::straddles;
}

PlanarPart Prism::planes_within(const LocalBox& box, std::vector<Plane>& planes) const {
  planes.clear();
  if (scale != 1) return PlanarPart::unknown;
  const double bottom_z = low(), top_z = high();
  if (box.bounds.lower.z <= bottom_z && bottom_z <= box.bounds.upper.z) planes.push_back({{0, 0, -1}, -bottom_z});
  if (box.bounds.lower.z <= top_z && top_z <= box.bounds.upper.z) planes.push_back({{0, 0, 1}, top_z});

  std::array<std::uint32_t, 4> walls_there{};
  std::size_t count = 0;
  const bool are_few = visit_walls(box, 1, 1, [&](std::uint32_t i) {
    if (edges_.edges()[i].is_arc() || count == walls_there.size()) return false;
    walls_there[count++] = i;
    return true;
  });
  if (!are_few) return PlanarPart::unknown;
  if (count == 0) {
    const bool is_inside = edges_.contains({box.center.x, box.center.y});
    return !planes.empty() && is_inside ? PlanarPart::below_all : PlanarPart::unknown;
  }
  const auto wedge = find_wedge(edges_, std::span(walls_there).first(count), box);
  // What a cap leaves of all but a notch is not of either kind.
  if (!wedge || !(wedge->is_solid || planes.empty())) return PlanarPart::unknown;
  for (std::size_t i = 0; i < count; ++i) {
    const HalfPlane& side = wedge->sides[i];
    planes.push_back({{side.normal.x, side.normal.y, 0}, side.d});
  }
  return wedge->is_solid ? PlanarPart::below_all : PlanarPart::above_any;
}

bool Prism::walls_within(const LocalBox& box, std::size_t most, SweptPart& part) const {
  part.walls.clear();
  part.low = low();
  part.high = high();
  part.scale_slope = scale == 1 ? 0 : slope();
  part.scale = 1 - low() * part.scale_slope;
  const double s1 = scale_at(box.bounds.lower.z), s2 = scale_at(box.bounds.upper.z);
  const double slack = scale == 1 ? 0 : gamma(8) * (1 + scale + std::fabs(s1) + std::fabs(s2));
  part.least_scale = std::min(s1, s2) - slack;
  part.most_scale = std::max(s1, s2) + slack;
  // Towards a tip everything is small against its errors.
  if (!(part.least_scale > 0x1p-6 * std::max(1.0, scale))) return false;
  const bool are_few = visit_walls(box, part.least_scale, part.most_scale, [&](std::uint32_t i) {
    if (part.walls.size() == most) return false;
    part.walls.push_back({edges_.edges()[i], i});
    return true;
  });
  if (!are_few) return false;
  part.choose_place(box, edges_, [&](const Vec3& p) {
    const double s = scale == 1 ? 1 : scale_at(p.z);
    return Vec2{p.x / s, p.y / s};
  });
  return true;
}

// A point of a box, between the caps if the box is anywhere.
Vec3 Prism::point_between_caps(const LocalBox& box) const {
  const double z = std::clamp(box.center.z, low(), high()), missing = z - box.center.z;
  if (missing == 0) return box.center;
  // Towards the corner nearest to them.
  Vec3 way;
  for (const Vec3& half_edge : box.half_edges) way += half_edge * (half_edge.z * missing > 0 ? 1.0 : -1.0);
  const double part = way.z == 0 ? 0 : std::min(missing / way.z, 1.0);
  return {box.center.x + part * way.x, box.center.y + part * way.y, z};
}

Vec3 Prism::normal(const Vec3& point, std::uint32_t face) const {
  if (face < walls) return {0, 0, face == top ? 1.0 : -1.0};
  const OutlineEdge& edge = edges_.edges()[(face - walls) / 2];
  const double k = scale == 1 ? 0 : slope(), s = scale == 1 ? 1 : scale_at(point.z);
  // Of q((x, y) / s(z)), times s; at the tip every direction is one.
  const Vec2 p =
      s > 0 ? Vec2{point.x / s, point.y / s} : Vec2{0.5 * (edge.from.x + edge.to.x), 0.5 * (edge.from.y + edge.to.y)};
  const Vec2 n = edge.normal(p - edge.from);
  const Vec3 outward{n.x, n.y, -dot(n, p) * k};
  return (face - walls) % 2 == 0 ? outward : -outward;
}

}  // namespace tenon
