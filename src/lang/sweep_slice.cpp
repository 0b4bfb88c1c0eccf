#include "lang/sweep_slice.h"

#include <algorithm>
#include <cmath>

#include "plane/arc_corners.h"
#include "plane/arc_fit.h"
#include "plane/line_crossings.h"
#include "plane/mapped_outline.h"
#include "plane/outline_figures.h"

namespace tenon::lang {

namespace {

/// An outline swept along z while it turns clockwise, by degrees, and is scaled.
struct Sweep {
  Outline outline;
  double low = 0, high = 0;
  double twist = 0;
  Vec2 from{1, 1}, to{1, 1};
};

std::optional<Sweep> sweep_of(const UnionLeaf& leaf) {
  const auto number = [&](std::size_t i) { return std::get<double>(leaf.values[i]); };
  if (const auto extrusion = extrusion_of(leaf)) return Sweep{extrusion->outline, extrusion->low, extrusion->high};
  Sweep sweep;
  const auto set_height = [&](double h, std::size_t center) {
    sweep.low = std::get<bool>(leaf.values[center]) ? -h / 2 : 0;
    sweep.high = sweep.low + h;
  };
  if (leaf.kind == "prism" || leaf.kind == "twisted_prism") {
    sweep.outline = std::get<Outline>(leaf.values[0]);
    set_height(number(1), 2);
    const bool turns = leaf.kind == "twisted_prism";
    sweep.twist = turns ? number(3) : 0;
    sweep.to = turns ? Vec2{number(4), number(5)} : Vec2{number(3), number(3)};
    return sweep;
  }
  if (leaf.kind != "cone") return std::nullopt;
  sweep.outline.loops = {full_circle({{0, 0}, 1}, 1)};
  set_height(number(0), 3);
  sweep.from = {number(1), number(1)};
  sweep.to = {number(2), number(2)};
  return sweep;
}

// One whose ends are parallel to the plane. As for straight ones, what lies lower counts of both ends.
Shape slice_across(const Sweep& sweep, const Affine3& map) {
  const double z = -map.m[2][3] / map.m[2][2], share = (z - sweep.low) / (sweep.high - sweep.low);
  const bool meets = map.m[2][2] > 0 ? share >= 0 && share < 1 : share > 0 && share <= 1;
  const Vec2 scale = sweep.from + share * (sweep.to - sweep.from);
  if (!meets || scale.x == 0 || scale.y == 0) return {};
  const double c = cos_degrees(-sweep.twist * share), s = sin_degrees(-sweep.twist * share);
  const Affine3 here{{{{scale.x * c, -scale.x * s, 0, 0}, {scale.y * s, scale.y * c, 0, 0}, {0, 0, 1, 0}}}};
  return Shape::of(mapped(sweep.outline, map * Affine3::translate({0, 0, z}) * here));
}

/// A sweep that is scaled evenly, cut aslant. Each of its points lies on the way of one point of the outline, which
/// crosses the plane once or never: where its ends lie on different sides of it.
class AslantSlice {
 public:
  AslantSlice(const Sweep& sweep, const Affine3& map)
      : sweep_(sweep), map_(map), slope_{map.m[2][0], map.m[2][1]}, reach_(largest_coordinate(sweep.outline)) {}

  std::optional<Shape> shape() {
    const double steepness = length(slope_), widest = std::max(sweep_.from.x, sweep_.to.x);
    // The ways that end, or begin, in the plane; of an end that is a point all do or none.
    const bool by_high = sweep_.to.x > sweep_.from.x;
    const PlaneLine line = crossed_at(by_high ? 1 : 0);
    const double across = steepness * reach_ * widest;
    const double largest = across + std::fabs(map_.m[2][2]) * std::max(std::fabs(sweep_.low), std::fabs(sweep_.high)) +
                           std::fabs(map_.m[2][3]);
    const double apart = std::fabs(height_at(by_high ? 0 : 1, line.point(0)));
    if (apart <= turn_rounding * largest) return Shape::of(along(line));
    // Corners of what is between two such lines, which are known to 2^-52, would have less than 28 true bits.
    if (apart <= 0x1p-24 * largest) return std::nullopt;
    return Shape::of(
        image(resolve({Shape::Operation::intersect, {}, {Shape::of(sweep_.outline), Shape::of(strip())}})));
  }

 private:
  double scale_at(double share) const { return sweep_.from.x + share * (sweep_.to.x - sweep_.from.x); }
  double z_at(double share) const { return sweep_.low + share * (sweep_.high - sweep_.low); }

  // How far over the plane a point of the outline is after a share of its way.
  double height_at(double share, const Vec2& p) const {
    return scale_at(share) * dot(slope_, p) + map_.m[2][2] * z_at(share) + map_.m[2][3];
  }
  Vec2 image(double share, const Vec2& p) const {
    const double scale = scale_at(share);
    const Vec3 q = map_.point({scale * p.x, scale * p.y, z_at(share)});
    return {q.x, q.y};
  }
  Vec2 image(const Vec2& p) const {
    const double low = height_at(0, p), high = height_at(1, p);
    return image(low == high ? 0 : std::clamp(low / (low - high), 0.0, 1.0), p);
  }

  // Of the outline's plane, where ways are in the plane z = 0 after a share that does not end in a point.
  PlaneLine crossed_at(double share) const {
    const double steepness = length(slope_);
    return {1 / steepness * slope_, -(map_.m[2][2] * z_at(share) + map_.m[2][3]) / (steepness * scale_at(share))};
  }

  // Ways that cross the plane, as far out as the outline goes.
  Outline strip() const {
    const double far = 2 * reach_;
    const Vec2 normal = 1 / length(slope_) * slope_;
    // Between these distances along the slope.
    double first = -far, last = far;
    const auto cut = [&](double share, double other) {
      if (scale_at(share) == 0) return;
      const PlaneLine line = crossed_at(share);
      // Beyond the line this end is above; the ways cross where the other one is not.
      const bool other_is_nearer =
          scale_at(other) > 0 ? crossed_at(other).distance < line.distance : height_at(other, line.point(0)) > 0;
      double& end = other_is_nearer ? last : first;
      end = std::clamp(line.distance, -far, far);
    };
    cut(0, 1);
    cut(1, 0);
    const PlaneLine low{normal, first}, high{normal, last};
    Outline strip;
    auto& loop = strip.loops.emplace_back();
    for (const Vec2& p : {low.point(far), low.point(-far), high.point(-far), high.point(far)})
      loop.push_back({p.x, p.y, 0});
    return strip;
  }

  // Where ways of the outline's points cross the plane.
  Outline image(const Outline& outline) const {
    Outline result;
    for (const auto& corners : outline.loops) {
      auto& loop = result.loops.emplace_back();
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const OutlineCorner &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const Vec2 from{a.x, a.y}, to{b.x, b.y};
        if (a.bulge == 0) {
          const Vec2 p = image(from);
          loop.push_back({p.x, p.y, 0});
          continue;
        }
        const auto arc = arc_points(from, to, a.bulge);
        const auto conic = [&](double t) { return image(arc(t)); };
        double size = 0;
        for (const double t : {0.25, 0.5, 0.75, 1.0}) size = std::max(size, length(conic(t) - conic(0)));
        fit_arcs(conic, 0, 1, 0x1p-20 * size, loop);
      }
    }
    return result;
  }

  // The plane holds all ways of the points on a line.
  Outline along(const PlaneLine& line) const {
    Outline result;
    const std::vector<double> ends = line_crossings(sweep_.outline, line, turn_rounding * reach_);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      const Vec2 a = line.point(ends[i]), b = line.point(ends[i + 1]);
      auto& loop = result.loops.emplace_back();
      for (const Vec2& p : {image(0, a), image(0, b), image(1, b), image(1, a)}) loop.push_back({p.x, p.y, 0});
    }
    return result;
  }

  const Sweep& sweep_;
  const Affine3& map_;
  const Vec2 slope_;    // how much higher it is along x and y
  const double reach_;  // of the outline
};

}  // namespace

std::optional<Shape> slice_of_sweep(const UnionLeaf& leaf) {
  auto sweep = sweep_of(leaf);
  if (!sweep || !leaf.map.inverse()) return std::nullopt;
  const double tilt = std::hypot(leaf.map.m[2][0], leaf.map.m[2][1]);
  if (tilt <= turn_rounding * std::fabs(leaf.map.m[2][2])) return slice_across(*sweep, leaf.map);
  const bool is_even = sweep->from.x == sweep->from.y && sweep->to.x == sweep->to.y;
  if (sweep->twist != 0 || !is_even) return std::nullopt;
  return AslantSlice(*sweep, leaf.map).shape();
}

}  // namespace tenon::lang
