// hull() of solids.
#include "lang/convex_solid.h"

namespace tenon {
namespace {

TEST(HullOfSolids, OfBallsIsExact) {
  Random random(20240614);
  for (int round = 0; round < 25; ++round) {
    SCOPED_TRACE(round);
    std::vector<SpanningBall> balls;
    // Two have a cone alone, three are flat, and many have planes; some lie within others.
    for (int i = 2 + random.below(6); i > 0; --i) balls.push_back({6.0 * random.in_cube(), random.uniform(0.5, 3)});
    expect_hull("hull() {\n" + scad_of(balls) + "}", balls, random, 1e-9);
  }
}

TEST(HullOfSolids, OfEqualBallsOnAGridIsARoundedBox) {
  Random random(20240615);
  std::vector<SpanningBall> balls;
  for (int i = 0; i < 12; ++i) {
    balls.push_back({{i % 2 * 5.0, i / 2 % 2 * 4.0, static_cast<double>(i / 4) * 3.0}, 1});
  }
  const std::string text = "hull() {\n" + scad_of(balls) + "}";
  expect_hull(text, balls, random, 1e-9);
  EXPECT_NE(tree_of(text).find("convex_polyhedron("), std::string::npos);
  // On a line and in a plane, too.
  for (const std::size_t count : {2, 4}) {
    const std::vector<SpanningBall> some(balls.begin(), balls.begin() + static_cast<std::ptrdiff_t>(count));
    expect_hull("hull() {\n" + scad_of(some) + "}", some, random, 1e-9);
  }
  expect_hull("hull() { sphere(1); translate([3, 0, 0]) sphere(1); translate([7, 0, 0]) sphere(1); }",
              {{{0, 0, 0}, 1}, {{7, 0, 0}, 1}}, random, 1e-9);
}

TEST(HullOfSolids, OfPolyhedraIsAPolyhedron) {
  Random random(20240616);
  const std::string corner =
      "polyhedron([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], "
      "[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);";
  std::vector<SpanningBall> points{{{0, 0, 0}, 0}, {{1, 0, 0}, 0}, {{0, 1, 0}, 0}, {{0, 0, 1}, 0}, {{5, 6, 7}, 2}};
  expect_hull("hull() { " + corner + " translate([5, 6, 7]) sphere(2); }", points, random, 1e-9);
  points.back().radius = 0;
  points.push_back({{6, 6, 7}, 0});
  points.push_back({{5, 7, 7}, 0});
  points.push_back({{5, 6, 8}, 0});
  expect_hull("hull() { " + corner + " translate([5, 6, 7]) " + corner + " }", points, random, 1e-9);
  EXPECT_EQ(tree_of("hull() { cube(2); translate([1, 1, 1]) cube(1); }").find("mesh"), std::string::npos);
}

TEST(HullOfSolids, OfExtrusionsSideBySideIsAnExtrusion) {
  const std::string tree =
      tree_of("rotate([90, 0, 0]) hull() { cylinder(h = 2, r = 1); translate([5, 0, 0]) cylinder(h = 2, r = 1); }");
  EXPECT_NE(tree.find("prism(outline = [[["), std::string::npos) << tree;
  EXPECT_NE(tree.find("h = 2, center = false"), std::string::npos) << tree;
  EXPECT_EQ(tree_of("hull() cylinder(h = 2, r = 1);"),
            "prism(outline = [[[0, -1, 1], [0, 1, 1]]], h = 2, center = false, scale = 1);\n");
}

TEST(HullOfSolids, OfSolidsAroundOneAxisIsExact) {
  const std::string text =
      "translate([1, 2, 3]) rotate([90, 0, 0]) hull() { cylinder(h = 2, r = 1); translate([0, 0, 5]) rotate(30) "
      "cylinder(h = 1, r1 = 3, r2 = 0); translate([0, 0, -4]) rotate([20, 30, 40]) sphere(2); torus(4, 0.5); }";
  const std::string tree = tree_of(text);
  EXPECT_NE(tree.find("revolution(outline = [[["), std::string::npos) << tree;
  EXPECT_EQ(tree.find("mesh"), std::string::npos) << tree;
  const UnionScene scene(text);
  for (int i = 0; i < 100; ++i) {
    const Vec3 n = normalize(Vec3{std::cos(i), std::sin(i), std::sin(3.0 * i)});
    // Turned, its z axis points along -y.
    const double across = std::hypot(n.x, n.z), along = -n.y;
    const double expected =
        std::max({across, across + 2 * along, 3 * across + 5 * along, 6 * along, 2 - 4 * along, 4 * across + 0.5});
    EXPECT_NEAR(scene.support(n), expected + dot(n, {1, 2, 3}), 1e-9);
  }
  // Beside the axis, or stretched, they have none in common.
  EXPECT_EQ(tree_of("hull() { cylinder(h = 2, r = 1); translate([0.1, 0, 5]) sphere(1); }").find("revolution"),
            std::string::npos);
  EXPECT_EQ(
      tree_of("hull() { cylinder(h = 2, r = 1); translate([0, 0, 5]) scale([1, 1, 2]) sphere(1); }").find("revolution"),
      std::string::npos);
}

TEST(HullOfSolids, OfABoxBesideATurnedCylinderIsAnExtrusion) {
  const std::string tree =
      tree_of("hull() { cube([4, 2, 1]); translate([8, 2, 0]) rotate([90, 0, 0]) cylinder(h = 2, r = 1); }");
  EXPECT_NE(tree.find("prism(outline = [[["), std::string::npos) << tree;
}

TEST(HullOfSolids, OfOtherRoundSolidsIsAPolyhedronWithin) {
  const UnionScene scene("hull() { cylinder(h = 2, r = 1); translate([0, 1e-6, 5]) cylinder(h = 1, r = 3); }");
  for (int i = 0; i < 50; ++i) {
    const Vec3 n{std::cos(i), std::sin(i), 0.3 * std::sin(2.0 * i)};
    const double across = std::hypot(n.x, n.y);
    const double expected = std::max({across, across + 2 * n.z, 3 * across + 5 * n.z, 3 * across + 6 * n.z});
    EXPECT_LE(scene.support(n), expected + 1e-6);
    EXPECT_GE(scene.support(n), expected - 1.6e-4 * 3 - 1e-6);
  }
}

TEST(HullOfSolids, SaysWhatItCannotDo) {
  EXPECT_NE(
      error_of("hull() { difference() { cube(2); sphere(1); } }").find("1:1: error: hull() of a difference or an"),
      std::string::npos);
  EXPECT_NE(error_of("hull() halfspace();").find("hull() of a"), std::string::npos);
  // A plate with a hole is an extrusion.
  EXPECT_EQ(tree_of("hull() difference() { cube([4, 4, 1]); translate([1, 1, -1]) cylinder(h = 3, r = 1); }"),
            tree_of("hull() cube([4, 4, 1]);"));
  EXPECT_EQ(tree_of("hull(); cube();"), tree_of("cube();"));
}

}  // namespace
}  // namespace tenon
