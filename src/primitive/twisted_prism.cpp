#include "primitive/twisted_prism.h"

#include <algorithm>
#include <cmath>

#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/twisted_line.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// A thousand turns: beyond, a height of one in a million is a turn.
constexpr double most_degrees = 360e3;

}  // namespace

std::string TwistedPrism::check() const {
  if (std::string problem = check_outline(name, outline); !problem.empty()) return problem;
  if (!(std::fabs(twist) <= most_degrees)) {
    return std::string(name) + " with twist = " + shortest(twist) + " turns too often; twists end at 360000 degrees";
  }
  return check_lengths(name, {{"h", h}, {"scale_x", scale_x, true}, {"scale_y", scale_y, true}});
}

void TwistedPrism::prepare() {
  if (!check().empty()) return;
  edges_ = OutlineEdges(outline);
  reach_ = length(edges_.reach()) * largest_scale() * (1 + gamma(8));
  double nearest = Box3::inf;
  for (const OutlineEdge& edge : edges_.edges()) {
    nearest = std::min(nearest, length(max(Vec2{}, max(edge.lower, Vec2{} - edge.upper))));
  }
  clearance_ = nearest * least_scale() * (1 - gamma(8));
}

void TwistedPrism::spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const {
  Chord slab;
  SearchedPart whole;
  if (!find_part(ray, slab, whole)) return;
  const SearchedPart part = whole.within(window);
  if (part.is_empty()) return;
  // A cap beyond the window is not where a chord within it ends.
  if (slab.enter.hi < window.begin) slab.enter = Chord().enter;
  if (slab.leave.lo > window.end) slab.leave = Chord().leave;

  TwistedLine line = line_along(ray);
  thread_local std::vector<EdgeCrossing> crossings;
  thread_local std::vector<BoundaryCrossing> boundary;
  line.cross_edges(edges_, {whole.begin, whole.end}, window, crossings);
  const auto is_inside = [&](double t) {
    Vec2 place;
    return find_place(ray.origin + t * ray.direction, place) && edges_.contains(place);
  };
  const bool inside = find_boundary_crossings(crossings, part, is_inside, boundary);
  const std::size_t first = out.size();
  emit_between_caps(slab, boundary, inside, walls, out);
  if (scale_x == 0 || scale_y == 0) drop_chords_beyond_tip(ray, first, out);
}

// The part of a ray between the caps and beside the axis as far as any wall reaches; false where there is none.
bool TwistedPrism::find_part(const LocalRay& ray, Chord& slab, SearchedPart& whole) const {
  if (!clip_slab(ray, 2, low(), high(), bottom, top, slab)) return false;
  constexpr std::uint32_t no_face = 0x7fffffff;
  Chord over;
  for (int axis = 0; axis < 2; ++axis) {
    if (!clip_slab(ray, axis, -reach_, reach_, no_face, no_face, over)) return false;
  }
  whole = {std::max(over.enter.lo, slab.enter.lo), std::min(over.leave.hi, slab.leave.hi),
           over.enter.lo >= slab.enter.lo, over.leave.hi <= slab.leave.hi};
  return !whole.is_empty() && std::isfinite(whole.begin) && std::isfinite(whole.end);
}

TwistedLine TwistedPrism::line_along(const LocalRay& ray) const {
  const int on_edge = ray.on_face < static_cast<int>(walls) ? -1 : (ray.on_face - static_cast<int>(walls)) / 2;
  return {{low(), 1 / h, twist / 90, scale_x - 1, scale_y - 1, clearance_, reach_}, ray, on_edge};
}

std::optional<Crossing> TwistedPrism::crossing_near(const LocalRay& ray, double t, double near, bool entering) const {
  Chord slab;
  SearchedPart whole;
  // What lies beyond a tip is dropped by looking at all of it.
  if (scale_x == 0 || scale_y == 0 || !find_part(ray, slab, whole)) return std::nullopt;
  thread_local std::vector<EdgeCrossing> crossings;
  line_along(ray).cross_edges(edges_, {whole.begin, whole.end}, {t - 2 * near, t + 2 * near}, crossings);
  return crossing_between_caps(slab, crossings, t, near, entering, walls);
}

// Where the outline has shrunk to a line or a point, every point of the plane satisfies the equations of its edges. A
// chord there is one of the solid only if it is no farther out than the outline reaches.
void TwistedPrism::drop_chords_beyond_tip(const LocalRay& ray, std::size_t first, Spans& out) const {
  const double reach = length(edges_.reach());
  const auto is_beyond = [&](const Crossing& c) {
    const Vec3 p = abs(ray.origin + c.t * ray.direction);
    const Vec3 error = ray.origin_error + std::fabs(c.t) * ray.direction_error + c.bound * abs(ray.direction) +
                       gamma(4) * (p + abs(ray.origin));
    const double rest = std::max(0.0, high() - (ray.origin.z + c.t * ray.direction.z) + error.z) / h;
    const auto reaches = [&](double scale) { return reach * std::min(1.0, scale + rest * std::fabs(1 - scale)); };
    return p.x - error.x > reaches(scale_x) * std::max(1.0, scale_x) * (1 + gamma(8)) ||
           p.y - error.y > reaches(scale_y) * std::max(1.0, scale_y) * (1 + gamma(8));
  };
  const auto is_known = [](const Crossing& c) { return std::isfinite(c.t); };
  std::size_t kept = first;
  for (std::size_t i = first; i + 1 < out.size(); i += 2) {
    if (is_known(out[i]) && is_known(out[i + 1]) && is_beyond(out[i]) && is_beyond(out[i + 1])) continue;
    out[kept++] = out[i];
    out[kept++] = out[i + 1];
  }
  out.resize(kept);
}

double TwistedPrism::support(const Vec3& n) const {
  // At each of many heights. Between two of them no point goes beyond the straight way by more than an eighth of the
  // square of the step times its acceleration: of the turn, and of the turn and the change of scale together.
  const double turn = half_pi * std::fabs(twist / 90);
  const double growth = std::max(std::fabs(scale_x - 1), std::fabs(scale_y - 1));
  const double acceleration = turn * (turn * reach_ + 2 * growth * length(edges_.reach()));
  const int steps = turn == 0 ? 1 : 256 * static_cast<int>(1 + std::min(std::fabs(twist) / 360, 64.0));
  const double across = std::sqrt(n.x * n.x + n.y * n.y);
  const double slack = across * acceleration / (8.0 * steps * steps) * (1 + gamma(8));
  double best = -Box3::inf;
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const auto [sine, cosine] = quarter_turn_sine_cosine(twist / 90 * share);
    const double a = n.x * (1 + (scale_x - 1) * share), b = n.y * (1 + (scale_y - 1) * share);
    const double flat = edges_.support({cosine * a - sine * b, sine * a + cosine * b});
    best = std::max(best, flat + n.z * (low() + share * h));
  }
  return best + slack + gamma(32) * (across * reach_ * (1 + turn) + std::fabs(n.z) * (h + std::fabs(low())));
}

Region TwistedPrism::classify(const LocalBox& box) const {
  // A circle around the place of the box decides; parts of a box have smaller ones. Where a wall passes between two
  // corners no part needs to be looked at.
  constexpr int halvings = 24;
  BoxSearch search;
  if (const Region whole = classify(box.bounds); whole != Region::straddles) return whole;
  for (unsigned corner = 0; corner < 8; ++corner) {
    Vec3 p = box.center;
    for (unsigned i = 0; i < 3; ++i) p += (corner >> i & 1) != 0 ? box.half_edges[i] : -box.half_edges[i];
    search.look(contains(p));
    if (search.is_decided()) return Region::straddles;
  }
  return classify_parts(box.center, box.half_edges, box.error, halvings, search);
}

Region TwistedPrism::classify_parts(const Vec3& middle, const std::array<Vec3, 3>& half_edges, const Vec3& error,
                                    int halvings, BoxSearch& search) const {
  const Vec3 size = abs(half_edges[0]) + abs(half_edges[1]) + abs(half_edges[2]);
  const Vec3 reach = size + error + gamma(8) * (abs(middle) + size);
  const Region whole = classify(Box3{middle - reach, middle + reach});
  if (whole != Region::straddles || halvings == 0 || --search.parts_left <= 0) return whole;
  search.look(contains(middle));
  if (search.is_decided()) return whole;
  // Across the edge that moves the place in the outline farthest: by itself, or by the turn and the scales on its way
  // up.
  const double rise = reach_ / h * (half_pi * std::fabs(twist / 90) + std::fabs(scale_x - 1) + std::fabs(scale_y - 1));
  const auto effect = [rise](const Vec3& edge) { return length(Vec2{edge.x, edge.y}) + std::fabs(edge.z) * rise; };
  std::array<Vec3, 3> halves = half_edges;
  Vec3& longest = *std::max_element(halves.begin(), halves.end(),
                                    [&](const Vec3& a, const Vec3& b) { return effect(a) < effect(b); });
  longest = 0.5 * longest;
  const Region first = classify_parts(middle - longest, halves, error, halvings - 1, search);
  if (first == Region::straddles) return first;
  const Region second = classify_parts(middle + longest, halves, error, halvings - 1, search);
  return second == first ? first : Region::straddles;
}

bool TwistedPrism::find_place(const Vec3& p, Vec2& place) const {
  const double share = (p.z - low()) / h;
  const double sx = 1 + (scale_x - 1) * share, sy = 1 + (scale_y - 1) * share;
  if (!(sx > 0 && sy > 0)) return false;
  const auto [sine, cosine] = quarter_turn_sine_cosine(twist / 90 * share);
  const double a = p.x / sx, b = p.y / sy;
  place = {cosine * a - sine * b, sine * a + cosine * b};
  return true;
}

bool TwistedPrism::contains(const Vec3& p) const {
  Vec2 place;
  return p.z >= low() && p.z <= high() && find_place(p, place) && edges_.contains(place);
}

Region TwistedPrism::classify(const Box3& box) const {
  if (box.upper.z < low() || box.lower.z > high()) return Region::outside;
  const auto nearest = [](double lower, double upper) { return std::max({0.0, lower, -upper}); };
  const double x = nearest(box.lower.x, box.upper.x), y = nearest(box.lower.y, box.upper.y);
  if (std::sqrt(x * x + y * y) > reach_ * (1 + gamma(8))) return Region::outside;
  const bool between_caps = box.lower.z >= low() && box.upper.z <= high();
  const Vec3 farthest = max(abs(box.lower), abs(box.upper));
  if (length(Vec2{farthest.x, farthest.y}) * (1 + gamma(8)) < clearance_) {
    if (!edges_.contains({})) return Region::outside;
    return between_caps ? Region::inside : Region::straddles;
  }
  // What matters is what lies between the caps. Shares of the height, and where they take the box.
  const double from = std::clamp((box.lower.z - low()) / h, 0.0, 1.0);
  const double to = std::clamp((box.upper.z - low()) / h, 0.0, 1.0);
  const Cover places = cover(box, from, to);
  if (std::sqrt(x * x + y * y) > length(edges_.reach()) * places.most_scale * (1 + gamma(8))) return Region::outside;
  if (!(places.least_scale > 0) || !std::isfinite(places.spread)) return Region::straddles;
  if (!places.visit_edges(edges_, [](std::uint32_t) { return false; })) return Region::straddles;
  if (!edges_.contains(places.place)) return Region::outside;
  return between_caps ? Region::inside : Region::straddles;
}

// What of the outline's plane lies under the points of a box between two shares of the height.
TwistedPrism::Cover TwistedPrism::cover(const Box3& box, double from, double to) const {
  const double share = 0.5 * (from + to), half = 0.5 * (to - from) + gamma(8);
  const double sx = 1 + (scale_x - 1) * share, sy = 1 + (scale_y - 1) * share;
  const double sx_least = sx - half * std::fabs(scale_x - 1) - gamma(8) * (1 + scale_x);
  const double sy_least = sy - half * std::fabs(scale_y - 1) - gamma(8) * (1 + scale_y);
  Cover result;
  result.spread = HUGE_VAL;
  result.least_scale = std::min(sx_least, sy_least);
  result.most_scale = std::max(2 * sx - sx_least, 2 * sy - sy_least);
  if (!(result.least_scale > 0)) return result;
  const Vec3 middle = box.center(), size = 0.5 * box.size();
  const auto divide = [half](double value, double radius, double s, double s_least, double growth) {
    // |(value ± radius) / (s ± ds) - value / s|
    return (radius + std::fabs(value / s) * half * std::fabs(growth)) / s_least + gamma(8) * std::fabs(value / s);
  };
  const double a = middle.x / sx, b = middle.y / sy;
  const double a_radius = divide(middle.x, size.x, sx, sx_least, scale_x - 1);
  const double b_radius = divide(middle.y, size.y, sy, sy_least, scale_y - 1);
  const auto [sine, cosine] = quarter_turn_sine_cosine(twist / 90 * share);
  result.place = {cosine * a - sine * b, sine * a + cosine * b};
  result.far = length(Vec2{std::fabs(a) + a_radius, std::fabs(b) + b_radius});
  // A disc of places turns around the axis: its middle along a straight way, but for the arc's height, or anywhere.
  const double turn = half_pi * std::fabs(twist / 90) * half, from_axis = length(result.place);
  const bool is_short = turn <= 1;
  if (is_short) result.way = turn * Vec2{-result.place.y, result.place.x};
  const double beside = (is_short ? 0.5 * turn * turn : 2) * from_axis;
  const double slack = (sine_cosine_error + gamma(8) * (1 + std::fabs(twist))) * result.far;
  result.spread = (std::hypot(a_radius, b_radius) + beside + slack) * (1 + gamma(16));
  return result;
}

bool TwistedPrism::walls_within(const LocalBox& box, std::size_t most, TwistedPart& part) const {
  part.walls.clear();
  part.low = low();
  part.high = high();
  part.middle = box.center.z;
  part.turn = half_pi * (twist / 90) / h;
  const Box3& bounds = box.bounds;
  part.is_too_large = !(std::fabs(part.turn) * 0.5 * bounds.size().z <= TwistedPart::most_turn);
  if (part.is_too_large) return false;
  const Cover places = cover(bounds, (bounds.lower.z - low()) / h, (bounds.upper.z - low()) / h);
  // Towards a tip everything is small against its errors.
  if (!(places.least_scale > 0x1p-6 * largest_scale()) || !std::isfinite(places.spread)) return false;
  const double share = (part.middle - low()) / h, slope_x = (scale_x - 1) / h, slope_y = (scale_y - 1) / h;
  part.scale = {1 + (scale_x - 1) * share, 1 + (scale_y - 1) * share};
  part.scale_slope = {slope_x, slope_y};
  part.least_scale = places.least_scale;
  part.turn_to_here = half_pi * std::fabs(twist / 90 * share);
  part.reach = places.far;
  const bool are_few = places.visit_edges(edges_, [&](std::uint32_t i) {
    if (part.walls.size() == most) return false;
    part.walls.push_back({edges_.edges()[i], i});
    return true;
  });
  part.is_too_large = !are_few;
  if (!are_few) return false;
  part.choose_place(box, edges_, [&](const Vec3& p) {
    Vec2 place;
    find_place(p, place);
    return place;
  });
  // All of it as it stands over the middle.
  const auto [sine, cosine] = quarter_turn_sine_cosine(-twist / 90 * share);
  const auto turned = [s = sine, c = cosine](const Vec2& p) { return Vec2{c * p.x - s * p.y, s * p.x + c * p.y}; };
  part.place = turned(part.place);
  for (OutlineEdge& wall : part.walls) wall = OutlineEdge::between(turned(wall.from), turned(wall.to), wall.bulge);
  return true;
}

// The gradient of q (outline_edges.h) at R(turn) (x / sx, y / sy).
Vec3 TwistedPrism::normal(const Vec3& point, std::uint32_t face) const {
  if (face < walls) return {0, 0, face == top ? 1.0 : -1.0};
  const OutlineEdge& edge = edges_.edges()[(face - walls) / 2];
  const double share = std::clamp((point.z - low()) / h, 0.0, 1.0);
  const double sx = 1 + (scale_x - 1) * share, sy = 1 + (scale_y - 1) * share;
  const auto [sine, cosine] = quarter_turn_sine_cosine(twist / 90 * share);
  const double a = point.x / sx, b = point.y / sy;
  const Vec2 place{cosine * a - sine * b, sine * a + cosine * b};
  const Vec2 n = edge.normal(place - edge.from);
  const double na = cosine * n.x + sine * n.y, nb = cosine * n.y - sine * n.x;
  const double turning = half_pi * (twist / 90) / h * cross(place, n);
  const double shrinking = na * a * (scale_x - 1) / (sx * h) + nb * b * (scale_y - 1) / (sy * h);
  const Vec3 outward{na / sx, nb / sy, turning - shrinking};
  if (outward == Vec3{}) return {0, 0, 1};
  return (face - walls) % 2 == 0 ? outward : -outward;
}

}  // namespace tenon
