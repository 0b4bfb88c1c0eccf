#include "lang/ball_hull.h"

#include <algorithm>
#include <cmath>

#include "lang/polyhedron.h"
#include "lang/primitive_arguments.h"
#include "mesh/convex_hull.h"

namespace tenon::lang {

namespace {

constexpr std::size_t most_balls = 64;

/// A plane that touches balls, and lets all others lie behind it.
struct TouchingPlane {
  Vec3 normal;
  std::vector<std::size_t> balls;
};

class BallHull {
 public:
  BallHull(ModuleEvaluator& evaluator, std::vector<Ball> balls, Place at)
      : evaluator_(evaluator), balls_(std::move(balls)), at_(at) {
    double size = 0;
    for (const Ball& ball : balls_) size = std::max(size, max_component(abs(ball.center)) + ball.radius);
    // What the scene calls the same place is smaller; what rounding makes of centres that were multiplied is, too.
    same_place_ = 0x1p-40 * size;
    leave_out_covered();
  }

  Solid solid() {
    find_planes();
    Solids parts;
    if (Solid core = polyhedron(); !core.is_nothing()) parts.push_back(core);
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      for (std::size_t j = i + 1; j < balls_.size(); ++j) {
        if (is_edge(i, j)) add(cone(balls_[i], balls_[j]), parts);
      }
      if (balls_[i].radius > 0 && is_touched(i)) {
        add(moved(Affine3::translate(balls_[i].center), add_primitive(evaluator_, at_, "sphere", {balls_[i].radius})),
            parts);
      }
    }
    return evaluator_.builder().unite(parts);
  }

 private:
  static void add(const Solid& part, Solids& parts) {
    if (!part.is_nothing()) parts.push_back(part);
  }
  Solid moved(const Affine3& map, const Solid& solid) { return evaluator_.builder().wrap(Transform{map}, {solid}); }

  // Balls within others.
  void leave_out_covered() {
    std::stable_sort(balls_.begin(), balls_.end(), [](const Ball& a, const Ball& b) { return a.radius > b.radius; });
    std::vector<Ball> kept;
    for (const Ball& ball : balls_) {
      const bool covered = std::any_of(kept.begin(), kept.end(), [&](const Ball& other) {
        return length(ball.center - other.center) + ball.radius <= other.radius + same_place_;
      });
      if (!covered) kept.push_back(ball);
    }
    balls_ = std::move(kept);
  }

  void find_planes() {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      for (std::size_t j = i + 1; j < balls_.size(); ++j) {
        for (std::size_t k = j + 1; k < balls_.size(); ++k) try_planes(balls_[i], balls_[j], balls_[k]);
      }
    }
  }

  // The unit normals n with n·(b - a) = ra - rb and n·(c - a) = ra - rc.
  void try_planes(const Ball& a, const Ball& b, const Ball& c) {
    const Vec3 u = b.center - a.center, v = c.center - a.center, m = cross(u, v);
    const double square = dot(m, m);
    if (!(std::sqrt(square) > same_place_ * std::max(length(u), length(v)))) return;
    const Vec3 flat = ((a.radius - b.radius) * cross(v, m) + (a.radius - c.radius) * cross(m, u)) / square;
    const double rest = 1 - dot(flat, flat);
    if (rest < 0) return;
    for (const double side : {1.0, -1.0}) {
      const Vec3 n = normalize(flat + side * std::sqrt(rest / square) * m);
      const double d = dot(n, a.center) + a.radius;
      TouchingPlane plane{n, {}};
      bool holds = true;
      for (std::size_t l = 0; l < balls_.size() && holds; ++l) {
        const double over = dot(n, balls_[l].center) + balls_[l].radius - d;
        holds = over <= same_place_;
        if (over >= -same_place_) plane.balls.push_back(l);
      }
      const bool known = std::any_of(planes_.begin(), planes_.end(), [&](const TouchingPlane& other) {
        return other.balls == plane.balls && dot(other.normal, n) > 0;
      });
      if (holds && !known) planes_.push_back(std::move(plane));
    }
  }

  Solid polyhedron() {
    std::vector<Vec3> points;
    for (const TouchingPlane& plane : planes_) {
      for (const std::size_t i : plane.balls) points.push_back(balls_[i].center + balls_[i].radius * plane.normal);
    }
    const ConvexHull hull = convex_hull(points);
    return hull.faces.empty() ? Solid::nothing() : polyhedron_solid(evaluator_, hull.points, hull.faces, at_);
  }

  // Two planes meet along an edge. Where no plane touches three balls, their centres lie on a line.
  bool is_edge(std::size_t i, std::size_t j) const {
    if (planes_.empty()) return true;
    const auto touches_both = [&](const TouchingPlane& plane) {
      return std::binary_search(plane.balls.begin(), plane.balls.end(), i) &&
             std::binary_search(plane.balls.begin(), plane.balls.end(), j);
    };
    return std::count_if(planes_.begin(), planes_.end(), touches_both) >= 2;
  }
  bool is_touched(std::size_t i) const {
    return planes_.empty() || std::any_of(planes_.begin(), planes_.end(), [&](const TouchingPlane& plane) {
             return std::binary_search(plane.balls.begin(), plane.balls.end(), i);
           });
  }

  // The part of the cone around two balls between the circles in which it touches them.
  Solid cone(const Ball& a, const Ball& b) {
    if (a.radius == 0 && b.radius == 0) return Solid::nothing();
    const Vec3 w = b.center - a.center;
    const double d = length(w), sine = (a.radius - b.radius) / d;
    if (!(std::fabs(sine) < 1)) return Solid::nothing();
    const double cosine = std::sqrt((1 - sine) * (1 + sine));
    const Vec3 z = w / d;
    const Vec3 x = normalize(std::fabs(z.x) < 0.6 ? cross(z, {1, 0, 0}) : cross(z, {0, 1, 0})), y = cross(z, x);
    const Vec3 from = a.center + a.radius * sine * z;
    const double h = d - (a.radius - b.radius) * sine, r1 = a.radius * cosine, r2 = b.radius * cosine;
    const Solid part = r1 == r2 ? add_primitive(evaluator_, at_, "cylinder", {h, r1, false})
                                : add_primitive(evaluator_, at_, "cone", {h, r1, r2, false});
    return moved({{{{x.x, y.x, z.x, from.x}, {x.y, y.y, z.y, from.y}, {x.z, y.z, z.z, from.z}}}}, part);
  }

  ModuleEvaluator& evaluator_;
  std::vector<Ball> balls_;
  Place at_;
  double same_place_ = 0;
  std::vector<TouchingPlane> planes_;
};

std::vector<Ball> without_inner_points(const std::vector<Ball>& balls) {
  std::vector<Vec3> points;
  std::vector<Ball> kept;
  for (const Ball& ball : balls) {
    if (ball.radius > 0) {
      kept.push_back(ball);
    } else {
      points.push_back(ball.center);
    }
  }
  const ConvexHull hull = convex_hull(points);
  if (hull.faces.empty()) return balls;
  for (const Vec3& p : hull.points) kept.push_back({p, 0});
  return kept;
}

// Of a ball in rings, so far apart in degrees.
void add_points(const Ball& ball, std::vector<Vec3>& points) {
  if (ball.radius == 0) return points.push_back(ball.center);
  constexpr double step = 2;
  for (double polar = 0; polar <= 180; polar += step) {
    const double r = ball.radius * sin_degrees(polar), z = ball.radius * cos_degrees(polar);
    for (double angle = 0; angle<360; angle += r> 0 ? step : 360) {
      points.push_back(ball.center + Vec3{r * cos_degrees(angle), r * sin_degrees(angle), z});
    }
  }
}

}  // namespace

Solid ball_hull(ModuleEvaluator& evaluator, std::vector<Ball> balls, Place at) {
  const bool round = std::any_of(balls.begin(), balls.end(), [](const Ball& ball) { return ball.radius > 0; });
  // The points on the hull of the points are those that count.
  if (round && balls.size() > most_balls) balls = without_inner_points(balls);
  if (round && balls.size() <= most_balls) return BallHull(evaluator, std::move(balls), at).solid();
  std::vector<Vec3> points;
  for (const Ball& ball : balls) add_points(ball, points);
  const ConvexHull hull = convex_hull(points);
  if (!hull.faces.empty()) return polyhedron_solid(evaluator, hull.points, hull.faces, at);
  evaluator.environment().warn(at, "all points lie in a plane; their hull has no volume");
  return Solid::nothing();
}

}  // namespace tenon::lang
