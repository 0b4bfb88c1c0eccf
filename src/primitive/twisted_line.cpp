#include "primitive/twisted_line.h"

#include <cmath>
#include <optional>
#include <type_traits>

#include "tenon/math/box3.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// Beyond this an interval has no middle of its own.
constexpr int deepest = 60;
// Looks at one edge along one piece of the line; a line that runs along a wall just beside it would take ever more.
constexpr int most_looks = 512;

}  // namespace

TwistedLine::TwistedLine(const TwistedSweep& sweep, const LocalRay& ray, int on_edge)
    : sweep_(sweep),
      ray_(ray),
      on_edge_(on_edge),
      turn_per_t_(half_pi * sweep.quarter_turns * sweep.per_height * ray.direction.z) {}

// Where the line is within a time; the product and the sum round.
Ball TwistedLine::coordinate(int axis, double t, double half_width) const {
  const double o = ray_.origin[axis], d = ray_.direction[axis];
  const double oe = ray_.origin_error[axis], de = ray_.direction_error[axis];
  const double moved = t * d;
  const double away = (std::fabs(d) + de) * half_width;
  return Ball::rounded(o + moved, oe + std::fabs(t) * de + unit_roundoff * std::fabs(moved) + away);
}

template <class Arithmetic>
TwistedLine::Motion<typename Arithmetic::Number> TwistedLine::move(
    const Arithmetic& with, const typename Arithmetic::Number (&point)[3]) const {
  using Number = typename Arithmetic::Number;
  const Number height = with.subtract(point[2], with.constant({sweep_.low, 0}));
  // The share, with the rounding of 1 / height.
  const Number share = with.multiply(Ball::rounded(sweep_.per_height, 0), height);
  Motion<Number> m{point[0], point[1], with.constant({1, 0})};
  if (sweep_.growth_x != 0 || sweep_.growth_y != 0) {
    const Number sx = with.add(m.s, with.multiply(Ball::rounded(sweep_.growth_x, 0), share));
    const Number sy = with.add(m.s, with.multiply(Ball::rounded(sweep_.growth_y, 0), share));
    m = {with.multiply(point[0], sy), with.multiply(point[1], sx), with.multiply(sx, sy)};
  }
  if (sweep_.quarter_turns == 0) return m;
  Number sine, cosine;
  with.sine_cosine(with.multiply(Ball::rounded(sweep_.quarter_turns, 0), share), sine, cosine);
  return {with.subtract(with.multiply(cosine, m.ux), with.multiply(sine, m.uy)),
          with.add(with.multiply(sine, m.ux), with.multiply(cosine, m.uy)), m.s};
}

TwistedLine::Motion<Enclosure> TwistedLine::move_over(const Interval& interval) const {
  const double t = interval.middle(), half = interval.half_width();
  const auto along = [&](int axis) {
    const Ball speed{ray_.direction[axis], ray_.direction_error[axis]};
    return Enclosure::of(coordinate(axis, t, 0), speed, {0, 0}, half);
  };
  return move(EnclosureArithmetic(half), {along(0), along(1), along(2)});
}

TwistedLine::Motion<Ball> TwistedLine::move_within(const Interval& interval) const {
  const double t = interval.middle(), half = interval.half_width();
  return move(BallArithmetic(), {coordinate(0, t, half), coordinate(1, t, half), coordinate(2, t, half)});
}

// q of the edge (outline_edges.h) at U / S, times S, and for an arc times S once more.
template <class Arithmetic>
typename Arithmetic::Number TwistedLine::edge_function(const Arithmetic& with, const OutlineEdge& edge,
                                                       const Motion<typename Arithmetic::Number>& m) {
  using Number = typename Arithmetic::Number;
  const Number px = with.subtract(m.ux, with.multiply(edge.from.x, m.s));
  const Number py = with.subtract(m.uy, with.multiply(edge.from.y, m.s));
  // The chord rounds, and counts as the exact edge's through both of its ends.
  const Ball wx = Ball::rounded(edge.to.x - edge.from.x, 0), wy = Ball::rounded(edge.to.y - edge.from.y, 0);
  const Number across = with.subtract(with.multiply(wy, px), with.multiply(wx, py));
  if (!edge.is_arc()) return across;
  const Number qx = with.subtract(px, with.multiply(wx, m.s)), qy = with.subtract(py, with.multiply(wy, m.s));
  const Ball flatness{edge.flatness(), gamma(3) * std::fabs(edge.flatness())};
  const Number round = with.add(with.multiply(px, qx), with.multiply(py, qy));
  return with.add(with.multiply(edge.bulge, round), with.multiply(flatness, with.multiply(m.s, across)));
}

Enclosure TwistedLine::edge_over(const OutlineEdge& edge, const Interval& interval) const {
  return edge_function(EnclosureArithmetic(interval.half_width()), edge, move_over(interval));
}

Ball TwistedLine::edge_at(const OutlineEdge& edge, double t) const {
  return edge_function(BallArithmetic(), edge, move_within({t, t}));
}

Dual TwistedLine::edge_dual(const OutlineEdge& edge, double t) const {
  const auto along = [&](int axis) { return Dual{ray_.origin[axis] + t * ray_.direction[axis], ray_.direction[axis]}; };
  return edge_function(DualArithmetic(), edge, move(DualArithmetic(), {along(0), along(1), along(2)}));
}

void TwistedLine::cross_edges(const OutlineEdges& edges, const Interval& whole, const LineWindow& window,
                              std::vector<EdgeCrossing>& out) {
  out.clear();
  window_ = window;
  Interval parts[2];
  const int count = parts_beside_walls(whole, parts);
  const bool is_scaled = sweep_.growth_x != 0 || sweep_.growth_y != 0;
  for (int i = 0; i < count; ++i) {
    const double turn = std::fabs(turn_per_t_) * (parts[i].end - parts[i].begin) / half_pi;
    if (is_scaled) {
      search<EnclosedWay>(edges, parts[i], turn, out);
    } else {
      search<Capsule>(edges, parts[i], turn, out);
    }
  }
  std::erase_if(out, [&](const EdgeCrossing& c) { return !window.meets(c.lo, c.hi); });
  // The face the ray starts on is crossed there even where rounding has put the edge aside.
  if (on_edge_ < 0 || !whole.contains(0)) return;
  const auto index = static_cast<std::uint32_t>(on_edge_);
  const auto is_start = [index](const EdgeCrossing& c) { return c.given && c.edge == index; };
  if (std::any_of(out.begin(), out.end(), is_start)) return;
  const EdgeCrossing start = start_on(index, edges.edges()[index], whole);
  if (window.meets(start.lo, start.hi)) out.push_back(start);
}

EdgeCrossing TwistedLine::start_on(std::uint32_t index, const OutlineEdge& edge, const Interval& within) const {
  const Enclosure f = edge_over(edge, {0, 0});
  const double slope = f.slope.middle, error = f.middle.radius + std::fabs(f.middle.middle);
  const double doubt = doubt_around_zero(slope, 0.5 * f.curvature.middle, error);
  return EdgeCrossing::at_start(index, slope > 0, doubt, within.begin, within.end);
}

// Where the line is no farther from the axis than a wall reaches, and no nearer than one comes: a part, or two with the
// axis between them.
int TwistedLine::parts_beside_walls(const Interval& whole, Interval (&parts)[2]) const {
  const Vec2 o{ray_.origin.x, ray_.origin.y}, d{ray_.direction.x, ray_.direction.y};
  const double dd = dot(d, d), t = std::max(std::fabs(whole.begin), std::fabs(whole.end));
  // Of the distance from the axis, and once more for the foot: where that is off by its rounding, the distance changes
  // by less than that times the speed.
  const double error = 2 * (length(ray_.origin_error) + t * length(ray_.direction_error) +
                            gamma(8) * (length(o) + t * length(d) + sweep_.reach));
  const double foot = dd > 0 ? -dot(o, d) / dd : 0;
  const double nearest = length(o + foot * d);
  const double far = sweep_.reach + error, near = sweep_.clearance - error;
  if (nearest > far) return 0;
  // Squares differ by their roundings, which `error` covers as well.
  const auto half_chord = [&](double radius) { return std::sqrt((radius * radius - nearest * nearest) / dd); };
  const auto rounding = [&](double half) { return gamma(8) * (std::fabs(foot) + half); };
  double half = dd > 0 ? half_chord(far) : Box3::inf;
  half += rounding(half);
  const Interval within{std::max(whole.begin, foot - half), std::min(whole.end, foot + half)};
  if (!(within.begin <= within.end)) return 0;
  if (!(nearest < near)) {
    parts[0] = within;
    return 1;
  }
  half = dd > 0 ? half_chord(near) : Box3::inf;
  half -= rounding(half);
  int count = 0;
  for (const Interval& part : {Interval{within.begin, std::min(within.end, foot - half)},
                               Interval{std::max(within.begin, foot + half), within.end}}) {
    if (part.begin <= part.end) parts[count++] = part;
  }
  return count;
}

// By Taylor's theorem. With the speed w and the angular speed a in a plane that turns, the acceleration is 2 a w across
// the way and a² r to the axis.
Capsule TwistedLine::straight_way(const Interval& interval) const {
  const double t = interval.middle(), half = interval.half_width(), a = turn_per_t_;
  const Vec3 p = ray_.origin + t * ray_.direction;
  const Vec2 d{ray_.direction.x, ray_.direction.y};
  const Vec3 error = ray_.origin_error + (std::fabs(t) + half) * ray_.direction_error +
                     gamma(4) * (abs(ray_.origin) + std::fabs(t) * abs(ray_.direction));
  const double turn_per_height = sweep_.quarter_turns * sweep_.per_height;
  const double turn = turn_per_height * (p.z - sweep_.low);
  const auto [sine, cosine] = quarter_turn_sine_cosine(turn);
  const Vec2 place{cosine * p.x - sine * p.y, sine * p.x + cosine * p.y};
  const Vec2 speed{cosine * d.x - sine * d.y - a * place.y, sine * d.x + cosine * d.y + a * place.x};
  const double moving = length(d), far = length(place) + moving * half;
  const double bend = 0.5 * half * half * std::fabs(a) * (2 * moving + std::fabs(a) * far);
  // What the turn is wrong by moves all there is; and all of it rounds.
  const double turn_error = half_pi * (std::fabs(turn_per_height) * (error.z + gamma(2) * std::fabs(sweep_.low)) +
                                       gamma(4) * std::fabs(turn)) +
                            sine_cosine_error;
  const double slack =
      length(Vec2{error.x, error.y}) + (turn_error + gamma(16)) * (far + sweep_.reach) * (1 + std::fabs(a) * half);
  return {place, half * speed, (bend + slack) * (1 + gamma(8))};
}

// A box of the plane, as large as the scales make it.
bool TwistedLine::EnclosedWay::may_touch(const Vec2& lower, const Vec2& upper) const {
  const double least = motion.s.range.least(), most = motion.s.range.greatest();
  const auto may_be_over = [&](const Ball& u, double low, double high) {
    return u.greatest() >= std::min(low * least, low * most) && u.least() <= std::max(high * least, high * most);
  };
  return may_be_over(motion.ux.range, lower.x, upper.x) && may_be_over(motion.uy.range, lower.y, upper.y);
}

// Over `turn` quarter turns at most. Parts over which the motion is not yet much like a straight one, or over which it
// may cross edges, are halved until only the edges themselves can tell.
template <class Way>
void TwistedLine::search(const OutlineEdges& edges, const Interval& interval, double turn,
                         std::vector<EdgeCrossing>& out) {
  if (!window_.meets(interval.begin, interval.end)) return;
  constexpr double widest = 0.5, narrowest = 0.0625;
  // Of what is much wider than the window most is passed over in any case; nothing is reported before the last step.
  constexpr double much_wider = 4;
  const bool is_worth_a_look =
      turn <= narrowest || interval.end - interval.begin <= much_wider * (window_.end - window_.begin);
  if (turn <= widest && is_worth_a_look) {
    std::optional<Motion<Enclosure>> motion;
    Way way;
    if constexpr (std::is_same_v<Way, EnclosedWay>) {
      way.motion = motion.emplace(move_over(interval));
    } else {
      way = straight_way(interval);
    }
    const bool is_last = turn <= narrowest;
    const EnclosureArithmetic with(interval.half_width());
    const auto touches = [&way](const Vec2& lower, const Vec2& upper) { return way.may_touch(lower, upper); };
    const bool none_left = edges.visit_edges(touches, [&](std::uint32_t index) {
      const OutlineEdge& edge = edges.edges()[index];
      if (!way.may_cross(edge)) return true;
      if (!is_last) return false;
      if (!motion) motion = move_over(interval);
      looks_ = most_looks;
      cross_edge(index, edge, interval, edge_function(with, edge, *motion), 0, out);
      return true;
    });
    if (none_left) return;
  }
  // The start of a ray lies within one of the parts, not between two.
  double middle = interval.middle();
  if (middle == 0 && on_edge_ >= 0) middle = 0.5 * interval.begin;
  search<Way>(edges, {interval.begin, middle}, 0.5 * turn, out);
  search<Way>(edges, {middle, interval.end}, 0.5 * turn, out);
}

void TwistedLine::cross_edge(std::uint32_t index, const OutlineEdge& edge, const Interval& interval, const Enclosure& f,
                             int depth, std::vector<EdgeCrossing>& out) {
  if (!window_.meets(interval.begin, interval.end)) return;
  if (on_edge_ == static_cast<int>(index) && interval.contains(0)) {
    cross_start(index, edge, interval, f, depth, out);
    return;
  }
  if (f.range.has_sign()) return;
  if (f.slope.has_sign()) {
    narrow_down(index, edge, interval, f, out);
    return;
  }
  const double middle = interval.middle();
  if (is_in_doubt(edge, interval, f) || depth >= deepest || --looks_ <= 0) {
    const Interval there = clip_to_edge(edge, interval);
    report(index, edge, there.middle(), there, f.slope.middle > 0, false, out);
    return;
  }
  for (const Interval& half : {Interval{interval.begin, middle}, Interval{middle, interval.end}}) {
    cross_edge(index, edge, half, edge_over(edge, half), depth + 1, out);
  }
}

// Whether an interval is no wider than the errors, or the line lies in the edge's wall there as far as they can tell.
bool TwistedLine::is_in_doubt(const OutlineEdge& edge, const Interval& interval, const Enclosure& f) const {
  const double middle = interval.middle();
  if (!(interval.begin < middle && middle < interval.end)) return true;
  if (f.range.radius - f.middle.radius <= 2 * f.middle.radius) return true;
  if (f.middle.has_sign()) return false;
  // A function this smooth does not leave its errors between so many places in a row.
  constexpr int places = 8;
  for (int i = 0; i <= places; ++i) {
    const double t = interval.begin + (interval.end - interval.begin) * i / places;
    if (edge_at(edge, t).has_sign()) return false;
  }
  return true;
}

// One crossing is known to be at exactly 0.
void TwistedLine::cross_start(std::uint32_t index, const OutlineEdge& edge, const Interval& interval,
                              const Enclosure& f, int depth, std::vector<EdgeCrossing>& out) {
  const double quarter = 0.25 * (interval.end - interval.begin);
  if (f.slope.has_sign() || is_in_doubt(edge, interval, f) || depth >= deepest || --looks_ <= 0) {
    out.push_back(start_on(index, edge, interval));
    // Nothing is known of a second one so near.
    if (!f.slope.has_sign()) report(index, edge, interval.middle(), interval, !out.back().rising, false, out);
    return;
  }
  const Interval near{std::max(interval.begin, -quarter), std::min(interval.end, quarter)};
  for (const Interval& part : {Interval{interval.begin, near.begin}, near, Interval{near.end, interval.end}}) {
    if (part.begin < part.end) cross_edge(index, edge, part, edge_over(edge, part), depth + 1, out);
  }
}

// The function is monotonic over the interval.
void TwistedLine::narrow_down(std::uint32_t index, const OutlineEdge& edge, const Interval& interval,
                              const Enclosure& f, std::vector<EdgeCrossing>& out) const {
  const Ball at_begin = edge_at(edge, interval.begin), at_end = edge_at(edge, interval.end);
  const bool sure = at_begin.has_sign() && at_end.has_sign();
  if (sure && at_begin.is_positive() == at_end.is_positive()) return;
  const bool rising = f.slope.middle > 0;
  if (sure) {
    const double place = approach(edge, interval, at_begin.middle / (at_begin.middle - at_end.middle));
    Interval around;
    if (is_proven_near(edge, interval, place, around)) {
      report(index, edge, place, around, rising, true, out);
      return;
    }
  }
  double place = 0;
  Interval around = interval;
  if (narrow_by_enclosures(edge, f, around, place)) report(index, edge, place, around, rising, sure, out);
}

// Newton's method, as it is computed, until its steps are roundings.
// @param share  of the interval, where it begins
double TwistedLine::approach(const OutlineEdge& edge, const Interval& interval, double share) const {
  double t = interval.begin + share * (interval.end - interval.begin), last = Box3::inf;
  for (;;) {
    const Dual f = edge_dual(edge, t);
    const double next = std::clamp(t - f.value / f.slope, interval.begin, interval.end), step = std::fabs(next - t);
    if (!(step < 0.5 * last)) return t;
    t = next;
    last = step;
  }
}

// Whether the one crossing of an interval lies so near to a place that the signs beside it prove it. Where the slope is
// what it is there, the function is at least half as large again as its error from two and a half errors on.
bool TwistedLine::is_proven_near(const OutlineEdge& edge, const Interval& interval, double place,
                                 Interval& around) const {
  const double slope = std::fabs(edge_dual(edge, place).slope);
  const double reach = 2.5 * edge_at(edge, place).radius / slope + gamma(4) * std::fabs(place);
  around = {std::max(interval.begin, place - reach), std::min(interval.end, place + reach)};
  const Ball before = edge_at(edge, around.begin), behind = edge_at(edge, around.end);
  return before.has_sign() && behind.has_sign() && before.is_positive() != behind.is_positive();
}

// Newton's operator: middle - f(middle) / slope, for every slope there may be.
// @param interval  over which f is known
// @return whether anything is left: a line that misses within its errors leaves no common part
bool TwistedLine::narrow_by_enclosures(const OutlineEdge& edge, Enclosure f, Interval& interval, double& place) const {
  const bool rising = f.slope.middle > 0;
  place = interval.middle();
  for (int step = 0; step < deepest; ++step) {
    const double middle = interval.middle(), slope = std::fabs(f.slope.middle);
    const double least = slope - f.slope.radius;
    if (!(least > 0)) break;
    const double distance = rising ? -f.middle.middle : f.middle.middle;
    const double low = distance - f.middle.radius, high = distance + f.middle.radius;
    const double steep = 1 / (slope + f.slope.radius), shallow = 1 / least;
    Interval next{low * (low >= 0 ? steep : shallow), high * (high >= 0 ? shallow : steep)};
    const double rounding = gamma(6) * (std::fabs(next.begin) + std::fabs(next.end)) + gamma(2) * std::fabs(middle);
    next = {std::max(interval.begin, middle + next.begin - rounding),
            std::min(interval.end, middle + next.end + rounding)};
    if (!(next.begin <= next.end)) return false;
    place = std::clamp(middle + distance / slope, next.begin, next.end);
    const bool is_settled = !(next.half_width() < 0.5 * interval.half_width());
    interval = next;
    if (is_settled) break;
    f = edge_over(edge, interval);
  }
  return true;
}

// Where a place on an edge's line or circle is along the edge, within an interval.
TwistedLine::Along TwistedLine::along_edge(const OutlineEdge& edge, const Interval& interval) const {
  const Motion<Ball> m = move_within(interval);
  const Ball px = m.ux - edge.from.x * m.s, py = m.uy - edge.from.y * m.s;
  const Vec2 w = edge.chord();
  // What the rounding of the chord moves.
  const double slack = gamma(4) * (std::fabs(w.x) + std::fabs(w.y)) *
                       (std::fabs(px.middle) + px.radius + std::fabs(py.middle) + py.radius);
  Along result;
  const auto demand = [&](const Ball& value) {
    result.may_be_there = result.may_be_there && value.greatest() >= -slack;
    result.is_there = result.is_there && value.least() > slack;
  };
  if (edge.is_arc()) {
    const Ball side = w.y * px - w.x * py;
    demand(edge.bulge > 0 ? side : -1 * side);
  } else {
    const Ball along = w.x * px + w.y * py;
    demand(along);
    demand(dot(w, w) * m.s - along);
  }
  return result;
}

// What of an interval is not certainly beside an edge's ends: in steps that halve, from both sides.
TwistedLine::Interval TwistedLine::clip_to_edge(const OutlineEdge& edge, Interval interval) const {
  constexpr int steps = 12;
  double step = 0.5 * (interval.end - interval.begin);
  for (int i = 0; i < steps; ++i, step *= 0.5) {
    const Interval first{interval.begin, std::min(interval.begin + step, interval.end)};
    if (!along_edge(edge, first).may_be_there) interval.begin = first.end;
    const Interval last{std::max(interval.end - step, interval.begin), interval.end};
    if (!along_edge(edge, last).may_be_there) interval.end = last.begin;
  }
  return interval;
}

// Where the whole line or circle of an edge is crossed; of the edge itself that may be beside its ends.
void TwistedLine::report(std::uint32_t index, const OutlineEdge& edge, double t, const Interval& interval, bool rising,
                         bool sure, std::vector<EdgeCrossing>& out) const {
  const Along along = along_edge(edge, interval);
  if (!along.may_be_there) return;
  out.push_back({{t, interval.begin, interval.end}, index, rising, sure && along.is_there, false});
}

}  // namespace tenon
