#include "plane/recover.h"

#include <numbers>

#include "plane/arc_corners.h"
#include "plane/meet.h"

namespace tenon {

namespace {

using ClipperLib::IntPoint;
using ClipperLib::Path;

/// The edges of a polygon that follow one another on one curve.
struct Run {
  Curve curve;
  IntPoint from;    // where it begins; it ends where the next one begins
  double turn = 0;  // around the circle, in radians
};

double distance(const IntPoint& a, const IntPoint& b) {
  return std::hypot(static_cast<double>(a.X - b.X), static_cast<double>(a.Y - b.Y));
}

// Without corners that lie where the one before does; those of the outlines themselves stay.
Path without_repeats(const Chords& chords, const Path& path) {
  Path kept;
  for (const IntPoint& p : path) {
    if (kept.empty() || distance(kept.back(), p) > Chords::same_place) {
      kept.push_back(p);
    } else if (chords.is_corner(p)) {
      kept.back() = p;
    }
  }
  while (kept.size() > 1 && distance(kept.back(), kept.front()) <= Chords::same_place) kept.pop_back();
  return kept;
}

double perimeter(const Path& path) {
  double sum = 0;
  for (std::size_t i = 0; i < path.size(); ++i) sum += distance(path[i], path[(i + 1) % path.size()]);
  return sum;
}

/// Makes one loop of an outline of a polygon.
class LoopRecovery {
 public:
  LoopRecovery(const Chords& chords, const Path& path) : chords_(chords) { find_runs(path); }

  std::vector<OutlineCorner> loop() const {
    if (runs_.size() == 1) return circle_of(runs_.front());
    std::vector<OutlineCorner> loop;
    std::vector<Vec2> corners;
    for (std::size_t i = 0; i < runs_.size(); ++i) corners.push_back(corner(i));
    for (std::size_t i = 0; i < runs_.size(); ++i) add(runs_[i], corners[i], corners[(i + 1) % runs_.size()], loop);
    return loop;
  }

 private:
  double same_place() const { return Chords::same_place * chords_.unit(); }

  void find_runs(const Path& path) {
    for (std::size_t i = 0; i < path.size(); ++i) {
      const IntPoint &from = path[i], &to = path[(i + 1) % path.size()];
      Curve curve = chords_.curve_of(from, to);
      const double turn = turn_along(curve, from, to);
      if (runs_.empty() || !continues(runs_.back(), curve, turn)) runs_.push_back({curve, from, 0});
      runs_.back().turn += turn;
    }
    // The last run may go on over the polygon's first corner.
    if (runs_.size() > 1 && continues(runs_.back(), runs_.front().curve, runs_.front().turn)) {
      runs_.front().from = runs_.back().from;
      runs_.front().turn += runs_.back().turn;
      runs_.pop_back();
    }
  }

  bool continues(const Run& run, const Curve& curve, double turn) const {
    return run.turn * turn >= 0 && are_same_curve(run.curve, curve, same_place());
  }

  // The angle from one point to the other around the circle; 0 on a line.
  double turn_along(const Curve& curve, const IntPoint& from, const IntPoint& to) const {
    if (!curve.is_arc()) return 0;
    return angle_between(chords_.point(from) - curve.circle.center, chords_.point(to) - curve.circle.center);
  }

  // Where a run begins.
  Vec2 corner(std::size_t i) const {
    const Run &run = runs_[i], &before = runs_[(i + runs_.size() - 1) % runs_.size()];
    if (chords_.is_corner(run.from)) return chords_.point(run.from);
    const Vec2 found = chords_.point(run.from);
    const auto exact = meet(before.curve, run.curve, found, same_place());
    // Chords meet elsewhere than their arcs, but not a chord further along.
    const double reach = 2 * std::max(chords_.longest_chord(before.curve), chords_.longest_chord(run.curve));
    return exact && length(*exact - found) <= reach + same_place() ? *exact : found;
  }

  static void add(const Run& run, const Vec2& from, const Vec2& to, std::vector<OutlineCorner>& loop) {
    const Curve& curve = run.curve;
    if (!curve.is_arc()) return loop.push_back({from.x, from.y, 0});
    if (from == curve.from && to == curve.to && run.turn * curve.bulge > 0) {
      return loop.push_back({from.x, from.y, curve.bulge});
    }
    if (from == curve.to && to == curve.from && run.turn * curve.bulge < 0) {
      return loop.push_back({from.x, from.y, -curve.bulge});
    }
    // The angle between the ends, with the turns that the chords tell.
    constexpr double full = 2 * std::numbers::pi;
    double angle = angle_between(from - curve.circle.center, to - curve.circle.center);
    angle += full * std::round((run.turn - angle) / full);
    if (angle * run.turn <= 0) return loop.push_back({from.x, from.y, 0});
    add_arc(curve.circle.center, from, angle, loop);
  }

  // A loop on one curve alone.
  std::vector<OutlineCorner> circle_of(const Run& run) const {
    if (!run.curve.is_arc()) return {};
    return full_circle(run.curve.circle, run.turn > 0 ? 1 : -1);
  }

  const Chords& chords_;
  std::vector<Run> runs_;
};

}  // namespace

Outline recover_outline(const Chords& chords, const ClipperLib::Paths& paths) {
  Outline outline;
  for (const Path& path : paths) {
    const Path kept = without_repeats(chords, path);
    if (kept.size() < 3 || std::fabs(ClipperLib::Area(kept)) <= Chords::same_place * perimeter(kept)) continue;
    auto loop = LoopRecovery(chords, kept).loop();
    if (loop.size() >= 2) outline.loops.push_back(std::move(loop));
  }
  return outline;
}

}  // namespace tenon
