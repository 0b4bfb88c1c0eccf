#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "primitive/oracle.h"
#include "support/random.h"
#include "tenon/math/rounding.h"
#include "tenon/primitive/crossing.h"

namespace tenon {

inline std::string describe(const Spans& spans) {
  std::ostringstream text;
  text.precision(17);
  for (const Crossing& c : spans) {
    text << "\n  " << (c.entering ? "in  " : "out ") << c.t << " ± " << c.bound << " face " << c.face;
  }
  return text.str();
}

/// Sorted, even in number, alternating, with bounds that are numbers.
inline std::optional<std::string> check_order(const Spans& spans) {
  if (spans.size() % 2 != 0) return "odd count" + describe(spans);
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Crossing& c = spans[i];
    if (std::isnan(c.t) || !(c.bound >= 0)) return "not a number" + describe(spans);
    if (c.entering != (i % 2 == 0)) return "does not alternate" + describe(spans);
    if (c.surface) return "says it is a surface" + describe(spans);
    if (i > 0 && c.t < spans[i - 1].t) return "not sorted" + describe(spans);
  }
  return {};
}

/// What a computed ray may be wrong by against the exact line.
struct RayErrors {
  double origin = 0;
  double direction = 0;
  double blur = 0;  ///< of the exact line's own place, relative to its coordinates
};

/// Whether the place at t decides nothing: the line lies in the surface there, as far as double can tell. That is so
/// when both the place and the direction agree with the surface within the errors of the ray and a few roundings; then
/// inside and outside are both right.
template <class T>
bool decides_nothing(const oracle::Solid<T>& solid, const exact::Line<T>& line, double t, double span,
                     const RayErrors& errors, double blur) {
  const exact::Vec<T> p = line.at(t);
  const double d_length = length(line.direction.rounded());
  const double coordinate = length(line.origin.rounded()) + (std::fabs(t) + span) * d_length;
  const double place = errors.origin + std::fabs(t) * errors.direction + 16 * unit_roundoff * coordinate;
  const double turn = errors.direction / d_length + 16 * unit_roundoff;
  const std::size_t count = solid.faces(p).size();
  for (std::size_t face = 0; face < count; ++face) {
    const exact::Vec<T> g = solid.gradient(p, face, T(span * d_length) * T(0x1p-30));
    const double steepness = length(g.rounded());
    const double distance = std::fabs(static_cast<double>(solid.faces(p)[face]));
    const double slope = std::fabs(static_cast<double>(dot(g, line.direction)));
    if (distance <= blur * coordinate * steepness) return true;
    // A line that leaves the surface by a place's error within the span is as good as in it.
    const double across = turn * d_length + place / span;
    if (distance <= 2 * (place + span * d_length * turn) * steepness && slope <= 4 * across * steepness) return true;
  }
  return false;
}

/// Whether crossings can be those of the exact line with the exact solid: at any place that no crossing's interval
/// holds, being inside must agree with the crossings before it. Asked just outside each interval, midway between
/// crossings, and at `more` random places. This is all there is to bounds: it fails for a missed pair, for a crossing
/// too many, and for an interval that does not reach the exact crossing.
///
/// @param span  half the length of the part of the line around the solid, in t
template <class T>
std::optional<std::string> check_against(const oracle::Solid<T>& solid, const exact::Line<T>& line, const Spans& spans,
                                         double middle, double span, Random& random, int more,
                                         const RayErrors& errors = {}) {
  if (auto problem = check_order(spans)) return problem;
  // Nearer together than this, places on the line are one to T.
  const double d_length = length(line.direction.rounded());
  const double blur = std::max(errors.blur, 64 * (std::is_same_v<T, exact::Quad> ? 0x1p-112 : 0x1p-63));
  const auto resolution = [&](double t) { return blur * (length(line.origin.rounded()) / d_length + std::fabs(t)); };

  std::vector<double> places;
  for (std::size_t i = 0; i < spans.size(); ++i) {
    const Crossing& c = spans[i];
    if (!std::isfinite(c.t)) continue;
    // The end of the interval, rounded outward.
    const double reach = std::max(c.bound * (1 + 0x1p-52), resolution(c.t));
    places.push_back(std::nextafter(c.t - reach, -std::numeric_limits<double>::infinity()));
    places.push_back(std::nextafter(c.t + reach, std::numeric_limits<double>::infinity()));
    if (i > 0 && std::isfinite(spans[i - 1].t)) places.push_back(0.5 * c.t + 0.5 * spans[i - 1].t);
  }
  for (int i = 0; i < more; ++i) places.push_back(middle + span * random.uniform(-1, 1));
  for (const double t : places) {
    bool inside = false, undecided = false;
    for (const Crossing& c : spans) {
      undecided |= std::fabs(t - c.t) <= std::max(c.bound, resolution(t));
      if (c.t <= t) inside = !inside;
    }
    if (undecided || !std::isfinite(t)) continue;
    if (solid.contains(line.at(t)) == inside || decides_nothing(solid, line, t, span, errors, blur)) continue;
    std::ostringstream text;
    text.precision(17);
    text << "at t = " << t << " the crossings say " << (inside ? "inside" : "outside") << ", the definition does not:";
    return text.str() + describe(spans);
  }
  return {};
}

inline std::string describe(const Vec3& o, const Vec3& d) {
  std::ostringstream text;
  text << std::hexfloat << "\nray {" << o.x << ", " << o.y << ", " << o.z << "}, {" << d.x << ", " << d.y << ", " << d.z
       << '}';
  return text.str();
}

inline std::string describe(const std::vector<FieldValue>& values) {
  std::ostringstream text;
  text << "\nvalues" << std::hexfloat;
  for (const FieldValue& value : values) {
    if (const auto* number = std::get_if<double>(&value)) text << ' ' << *number;
    if (const auto* flag = std::get_if<bool>(&value)) text << ' ' << *flag;
    if (const auto* v = std::get_if<Vec3>(&value)) text << " {" << v->x << ", " << v->y << ", " << v->z << '}';
    if (const auto* planes = std::get_if<std::vector<Plane>>(&value)) {
      for (const Plane& p : *planes) {
        text << "\n  {{" << p.normal.x << ", " << p.normal.y << ", " << p.normal.z << "}, " << p.d << '}';
      }
    }
    if (const auto* outline = std::get_if<Outline>(&value)) {
      for (const auto& loop : outline->loops) {
        text << "\n  {";
        for (const OutlineCorner& c : loop) text << '{' << c.x << ", " << c.y << ", " << c.bulge << "}, ";
        text << '}';
      }
    }
    if (const auto* choice = std::get_if<Choice>(&value)) text << ' ' << choice->name();
    if (const auto* box = std::get_if<Box3>(&value)) {
      text << "\n  {{" << box->lower.x << ", " << box->lower.y << ", " << box->lower.z << "}, {" << box->upper.x << ", "
           << box->upper.y << ", " << box->upper.z << "}}";
    }
    if (const auto* coefficients = std::get_if<QuadricCoefficients>(&value)) {
      for (const double c : *coefficients) text << ' ' << c << ',';
    }
    if (const auto* terms = std::get_if<PolynomialTerms>(&value)) {
      for (const PolynomialTerm& t : *terms)
        text << "\n  {" << t.i << ", " << t.j << ", " << t.k << ", " << t.a << "},";
    }
    if (const auto* mesh = std::get_if<SharedMesh>(&value)) {
      for (const Vec3& v : (*mesh)->vertices) text << "\n  {" << v.x << ", " << v.y << ", " << v.z << "},";
      for (const auto& [a, b, c] : (*mesh)->triangles) text << " {" << a << ", " << b << ", " << c << "},";
    }
  }
  return text.str();
}

}  // namespace tenon
