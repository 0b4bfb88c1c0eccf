// minkowski() of shapes and solids.
#include <functional>

#include "lang/convex_solid.h"

namespace tenon {
namespace {

std::vector<SpanningBall> box_of_balls(const Vec3& size, double r) {
  std::vector<SpanningBall> balls;
  for (int i = 0; i < 8; ++i) {
    balls.push_back({{i & 1 ? size.x : 0, i & 2 ? size.y : 0, i & 4 ? size.z : 0}, r});
  }
  return balls;
}

TEST(Minkowski, OfPolyhedraAndSpheresIsExact) {
  Random random(20240619);
  expect_hull("minkowski() { cube([5, 4, 3]); sphere(1); }", box_of_balls({5, 4, 3}, 1), random, 1e-9);
  expect_hull("minkowski() { cube([5, 4, 3]); sphere(1); sphere(0.5); cube(1); }", box_of_balls({6, 5, 4}, 1.5), random,
              1e-9);
  expect_hull("minkowski() { cube([1, 2, 3]); translate([-1, 0, 0]) cube([2, 1, 1]); translate([1, 0, 0]) cube(1); }",
              box_of_balls({4, 4, 5}, 0), random, 1e-9);
  EXPECT_NE(tree_of("minkowski() { sphere(1); sphere(2); }").find("sphere(r = 3)"), std::string::npos);
}

TEST(Minkowski, OfUnionsIsTheUnionOfSums) {
  const UnionScene scene("minkowski() { union() { cube(1); translate([10, 0, 0]) cube(1); } sphere(1); }");
  EXPECT_NEAR(scene.support({1, 0, 0}), 12, 1e-12);
  // Between the parts there is nothing.
  EXPECT_EQ(scene.spans({{-5, 0.5, 0.5}, {1, 0, 0}}).size(), 2u);
}

TEST(Minkowski, OfExtrusionsIsAnExtrusion) {
  const std::string tree = tree_of("minkowski() { cube([4, 4, 1]); cylinder(h = 1, r = 1); }");
  EXPECT_EQ(tree.find("prism(outline = [[["), 0u) << tree;
  EXPECT_NE(tree.find("h = 2, center = false"), std::string::npos) << tree;
  EXPECT_EQ(tree.find("mesh"), std::string::npos);
  // One that is not convex, and turned.
  const UnionScene scene(
      "rotate([90, 0, 0]) minkowski() { linear_extrude(2) difference() { square(9); translate([3, 3]) square(3); } "
      "cylinder(h = 1, r = 1, center = true); }");
  EXPECT_EQ(scene.spans({{4.5, -0.5, -5}, {0, 0, 1}}).size(), 2u);
  EXPECT_NEAR(scene.support({1, 0, 0}), 10, 1e-9);
  EXPECT_NEAR(scene.support({0, -1, 0}), 2.5, 1e-9);
}

TEST(Minkowski, OfARoundSolidAndASphereIsRound) {
  const std::string tree = tree_of("minkowski() { cylinder(h = 4, r = 2); sphere(1); }");
  EXPECT_EQ(tree.find("revolution(outline = [[["), 0u) << tree;
  const UnionScene scene("minkowski() { translate([1, 2, 3]) cylinder(h = 4, r1 = 2, r2 = 3); sphere(1); }");
  for (int i = 0; i < 50; ++i) {
    const Vec3 n = normalize(Vec3{std::cos(i), std::sin(i), std::sin(3.0 * i)});
    const double across = std::hypot(n.x, n.y);
    const double expected = dot(n, {1, 2, 3}) + std::max(2 * across, 3 * across + 4 * n.z) + 1;
    EXPECT_NEAR(scene.support(n), expected, 1e-9);
  }
}

// A box is an extrusion along each of its edges.
TEST(Minkowski, OfABoxAndACylinderAlongAnyEdgeIsAnExtrusion) {
  for (const std::string turn : {"[90, 0, 0]", "[0, 90, 0]", "[0, 0, 90]", "[-90, 0, 90]"}) {
    const std::string text =
        "minkowski() { cube([5, 4, 3], center = true); rotate(" + turn + ") cylinder(h = 2, r = 1, center = true); }";
    EXPECT_EQ(tree_of(text).find("mesh"), std::string::npos) << tree_of(text);
    const UnionScene scene(text);
    for (int i = 0; i < 50; ++i) {
      const Vec3 n = normalize(Vec3{std::cos(i), std::sin(i), std::sin(3.0 * i)});
      const double along = std::fabs(turn == "[90, 0, 0]" ? n.y : turn == "[0, 0, 90]" ? n.z : n.x);
      const double expected = 2.5 * std::fabs(n.x) + 2 * std::fabs(n.y) + 1.5 * std::fabs(n.z) + along +
                              std::sqrt(std::max(0.0, 1 - along * along));
      EXPECT_NEAR(scene.support(n), expected, 1e-9) << text;
    }
  }
}

// Each end of a span stands a radius away from the plate, and between them the ball's centre reaches it.
void expect_rounded(const std::string& plate, double height, double radius,
                    const std::function<double(double, double)>& distance_in_plane) {
  const UnionScene scene("minkowski() { " + plate + " sphere(" + std::to_string(radius) + "); }");
  const auto distance = [&](const Vec3& p) {
    const double across = std::max(distance_in_plane(p.x, p.y), 0.0), along = std::max({-p.z, p.z - height, 0.0});
    return std::hypot(across, along);
  };
  Random random(20241125);
  int met = 0;
  for (int i = 0; i < 2'000; ++i) {
    const Vec3 aim{random.uniform(-1, 10), random.uniform(-1, 10), random.uniform(-1, height + 1)};
    const Vec3 way = random.direction(), origin = aim - 30 * way;
    const auto spans = scene.spans({origin, way});
    const auto place = [&](double t) { return origin + t * way; };
    double before = 0;
    for (const SolidSpan& span : spans) {
      EXPECT_NEAR(distance(place(span.t_in)), radius, 1e-9) << plate;
      EXPECT_NEAR(distance(place(span.t_out)), radius, 1e-9) << plate;
      EXPECT_LE(distance(place(0.5 * (span.t_in + span.t_out))), radius) << plate;
      EXPECT_GE(distance(place(0.5 * (before + span.t_in))), radius) << plate;
      before = span.t_out;
    }
    EXPECT_EQ(distance(aim) < radius,
              std::any_of(spans.begin(), spans.end(),
                          [](const SolidSpan& span) { return span.t_in < 30 && span.t_out > 30; }))
        << plate;
    met += static_cast<int>(spans.size());
  }
  EXPECT_GT(met, 1'000);
}

TEST(Minkowski, OfAPlateWithHolesAndASphereIsRoundedExactly) {
  const auto square = [](double x, double y, double low, double high) {
    const double dx = std::max({low - x, x - high, 0.0}), dy = std::max({low - y, y - high, 0.0});
    return dx > 0 || dy > 0 ? std::hypot(dx, dy) : -std::min({x - low, high - x, y - low, high - y});
  };
  const auto hole = [](double x, double y, double r) { return r - std::hypot(x - 4, y - 4); };
  expect_rounded("linear_extrude(2) difference() { square(9); translate([4, 4]) circle(3); }", 2, 0.5,
                 [&](double x, double y) { return std::max(square(x, y, 0, 9), hole(x, y, 3)); });
  // The corners are arcs, and the ball is larger than they are.
  expect_rounded("linear_extrude(3) translate([1, 1]) offset(0.5) square(7);", 3, 0.75,
                 [&](double x, double y) { return square(x, y, 1, 8) - 0.5; });
  // Corners inward and outward.
  expect_rounded("linear_extrude(1) difference() { square(9); translate([3, 3]) square(9); }", 1, 0.6,
                 [&](double x, double y) {
                   const auto box = [](double px, double py, double w, double h) {
                     return std::hypot(std::max({-px, px - w, 0.0}), std::max({-py, py - h, 0.0}));
                   };
                   return std::min(box(x, y, 9, 3), box(x, y, 3, 9));
                 });
}

TEST(Minkowski, OfShapesOfThePlane) {
  const std::string tree = tree_of("linear_extrude(1) minkowski() { square(4); circle(1); }");
  EXPECT_NE(tree.find("0.41421356237309"), std::string::npos) << tree;
  EXPECT_EQ(tree_of("linear_extrude(1) minkowski() { square(4); }"), tree_of("linear_extrude(1) square(4);"));
  EXPECT_NE(tree_of("linear_extrude(1) minkowski() { circle(4); translate([1, 2]) circle(1); }")
                .find("[[[1, -3, 1], [1, 7, 1]]]"),
            std::string::npos);
}

TEST(Minkowski, SaysWhatItCannotDo) {
  EXPECT_NE(error_of("minkowski() { difference() { cube(2); sphere(1); } sphere(1); }")
                .find("1:1: error: minkowski() of a difference or an intersection"),
            std::string::npos);
  EXPECT_NE(error_of("minkowski() { torus(3, 1); cube(1); }").find("of a torus that is not convex"), std::string::npos);
  EXPECT_EQ(tree_of("minkowski(); cube();"), tree_of("cube();"));
}

}  // namespace
}  // namespace tenon
