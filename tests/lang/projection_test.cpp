// projection() of solids, against what is known of them.
#include <algorithm>

#include "lang/convex_solid.h"
#include "lang/language.h"
#include "primitive/arc.h"
#include "primitive/outline_edges.h"

namespace tenon {
namespace {

// The outline that a scene of one prism has.
Outline outline_of(const std::string& text) {
  const Outcome outcome = evaluate("linear_extrude(1) " + text);
  EXPECT_TRUE(outcome.model.ok()) << (outcome.model ? "" : format_error(outcome.model.error()));
  if (!outcome.model) return {};
  const SceneGraph& graph = outcome.model->graph;
  if (!graph.root) return {};
  SceneNodeId id = graph.root;
  while (!graph[id].children.empty()) {
    EXPECT_EQ(graph[id].children.size(), 1u);
    id = graph[id].children.front();
  }
  const auto* leaf = std::get_if<PrimitiveLeaf>(&graph[id].content);
  if (!leaf) return {};
  EXPECT_EQ(graph.primitives.kind(leaf->primitive).name, "prism");
  return std::get<Outline>(graph.primitives.values(leaf->primitive)[0]);
}

double area_of(const Outline& outline) {
  double sum = 0;
  for (const auto& loop : outline.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const OutlineCorner &a = loop[i], &b = loop[(i + 1) % loop.size()];
      sum += 0.5 * (a.x * b.y - a.y * b.x);
      if (a.bulge == 0) continue;
      const double r = circle_of_arc({a.x, a.y}, {b.x, b.y}, a.bulge).radius, angle = 4 * std::atan(a.bulge);
      sum += 0.5 * r * r * (angle - std::sin(angle));
    }
  }
  return sum;
}

constexpr double pi = 3.14159265358979323846;

TEST(CutProjection, IsExactOfSpheresPolyhedraAndExtrusions) {
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) translate([0, 0, 3]) sphere(5);")), 16 * pi, 1e-9);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) scale([1, 2, 3]) rotate([20, 30, 40]) sphere(1);")), 2 * pi,
              1e-5);
  // The diagonal cut of a cube is a hexagon.
  EXPECT_NEAR(
      area_of(outline_of(
          "projection(cut = true) rotate([0, 54.735610317245346, 0]) rotate([0, 0, 45]) cube(2, center = true);")),
      3 * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) difference() { cube([4, 4, 4], center = true); "
                                 "cylinder(h = 9, r = 1, center = true); translate([2, 2, 0]) sphere(1); }")),
              16 - pi - pi / 4, 1e-9);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) polyhedron([[0, 0, -1], [4, 0, -1], [0, 4, -1], [0, 0, 3]], "
                                 "[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 2]]);")),
              0.5 * 9, 1e-9);
}

TEST(CutProjection, IsExactOfWhatIsScaledOrTurnedOnItsWayUp) {
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) translate([0, 0, -3]) cylinder(h = 4, r1 = 4, r2 = 0);")), pi,
              1e-12);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) translate([0, 0, 3]) rotate([180, 0, 0]) cylinder(h = 4, r1 = "
                                 "0, r2 = 4);")),
              9 * pi, 1e-9);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) translate([0, 0, -1]) linear_extrude(2, scale = 0.5) "
                                 "square([4, 6]);")),
              24 * 0.75 * 0.75, 1e-12);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) translate([7, 0, -1]) linear_extrude(4, scale = [0.2, 3], "
                                 "twist = 77) translate([1, 2]) circle(2);")),
              4 * pi * 0.8 * 1.5, 1e-5);
  // A quarter of the way up a square has turned clockwise by a quarter of 180 degrees.
  const Outline turned = outline_of(
      "projection(cut = true) translate([0, 0, -1]) linear_extrude(4, twist = 180) "
      "square(2);");
  ASSERT_EQ(turned.loops.size(), 1u);
  const auto& loop = turned.loops.front();
  const auto far = std::max_element(loop.begin(), loop.end(), [](const auto& a, const auto& b) { return a.x < b.x; });
  EXPECT_NEAR(far->x, std::sqrt(8.0), 1e-12);
  EXPECT_NEAR(far->y, 0, 1e-12);
  // The end that lies lower counts.
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) linear_extrude(2, scale = 0.5) square(2);")), 4, 1e-12);
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) mirror([0, 0, 1]) translate([0, 0, -2]) linear_extrude(2, "
                                 "scale = 0.5) square(2);")),
              1, 1e-12);
  EXPECT_EQ(tree_of("linear_extrude(1) projection(cut = true) mirror([0, 0, 1]) linear_extrude(2, twist = 9) square(2);"
                    "cube();"),
            tree_of("cube();"));
}

TEST(CutProjection, OfAFaceInThePlaneCountsAboveIt) {
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) cube(2);")), 4, 1e-12);
  EXPECT_EQ(tree_of("linear_extrude(1) projection(cut = true) translate([0, 0, -2]) cube(2); cube();"),
            tree_of("cube();"));
  // Of an extrusion that lies on its side.
  const std::string lying = "rotate([90, 0, 0]) linear_extrude(3) difference() { square([5, 2]); circle(1); }";
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) " + lying + ";")), 12, 1e-12);
  EXPECT_EQ(tree_of("linear_extrude(1) projection(cut = true) translate([0, 0, -2]) " + lying + "; cube();"),
            tree_of("cube();"));
}

// What is scaled towards a place beside its axis is sheared.
TEST(CutProjection, OfWhatIsShearedAlongItsAxisEndsWithIt) {
  const auto area = [](const std::string& solid) { return area_of(outline_of("projection(cut = true) " + solid)); };
  const std::string square = " linear_extrude(2, center = true, scale = 0.5) square(6, center = true);";
  EXPECT_NEAR(area("translate([0, 0, 0])" + square), 36 * 0.75 * 0.75, 1e-12);
  EXPECT_NEAR(area("translate([0, 0, 0.5])" + square), 36 * 0.875 * 0.875, 1e-12);
  EXPECT_EQ(area("translate([0, 0, 1.5])" + square), 0);
  EXPECT_EQ(area("translate([0, 0, -1.5])" + square), 0);
  EXPECT_EQ(area("translate([0, 0, -1.5]) rotate([180, 0, 0])" + square), 0);
  const auto sheared = [&](const char* z) {
    return area(std::string("multmatrix([[1, 0, 0.5, 0], [0, 1, 0, 0], [0, 0, 1, ") + z +
                "], [0, 0, 0, 1]]) linear_extrude(10) polygon([[0, 0], [5, 0], [5, 5], [2, 2], [0, 5]]);");
  };
  EXPECT_NEAR(sheared("-4"), 25 - 7.5, 1e-12);
  EXPECT_EQ(sheared("5"), 0);
  EXPECT_EQ(sheared("-25"), 0);
  EXPECT_EQ(sheared("-10"), 0);
}

TEST(CutProjection, IsExactOfWhatLiesOnItsSide) {
  const auto area = [](const std::string& solid) { return area_of(outline_of("projection(cut = true) " + solid)); };
  EXPECT_NEAR(area("rotate([0, 90, 0]) cylinder(h = 4, r = 1);"), 8, 1e-12);
  EXPECT_NEAR(area("translate([0, 0, 0.6]) rotate([0, 90, 30]) cylinder(h = 4, r = 1);"), 4 * 1.6, 1e-12);
  EXPECT_NEAR(area("rotate([90, 0, 0]) torus(3, 1);"), 2 * pi, 1e-12);
  EXPECT_NEAR(area("torus(3, 1);"), 12 * pi, 1e-9);
  // A cone cut along its axis, less a ball; and a turned profile.
  EXPECT_NEAR(area("rotate([90, 0, 0]) difference() { cylinder(h = 4, r1 = 2, r2 = 1); sphere(1); }"), 12 - pi / 2,
              1e-12);
  const std::string bowl = "rotate_extrude() polygon([[0, 0], [3, 0], [4, 3], [3.5, 3], [2.5, 1], [0, 1]]);";
  EXPECT_NEAR(area("rotate([90, 20, 0]) " + bowl), 9, 1e-12);
  EXPECT_NEAR(area("translate([5, 0, -2]) " + bowl), pi * (std::pow(3 + 2.0 / 3, 2) - 9), 1e-9);
}

/// What a cut has of the plane, against what the solid itself is there.
void expect_cut_is_of_solid(const std::string& solid, Random& random) {
  SCOPED_TRACE(solid);
  const OutlineEdges cut(outline_of("projection(cut = true) " + solid));
  const UnionScene scene(solid);
  int inside = 0, wrong = 0;
  for (int i = 0; i < 1000; ++i) {
    const bool here = i % 2 == 0 && !cut.edges().empty();
    const Vec2 low = here ? cut.lower() : Vec2{-6, -6}, high = here ? cut.upper() : Vec2{6, 6};
    const Vec2 p{random.uniform(low.x, high.x), random.uniform(low.y, high.y)};
    bool found = false;
    for (const SolidSpan& span : scene.spans({{p.x, p.y, 0}, {0.3, 0.4, 1}})) found |= span.t_in <= 0 && span.t_out > 0;
    inside += found;
    wrong += found != cut.contains(p);
  }
  // Of ellipses none is further off than 2⁻²⁰ of the size: one point of ten thousand may lie between.
  EXPECT_LE(wrong, 1);
  EXPECT_TRUE(inside > 0 || cut.edges().empty());
}

TEST(CutProjection, IsOfTheSolidHoweverItStands) {
  Random random(7);
  const auto number = [&](double low, double high) { return std::to_string(random.uniform(low, high)); };
  const std::string shapes[] = {"circle(2);", "difference() { square([4, 3], center = true); circle(1); }",
                                "translate([1, 0.5]) circle(1.5, $fn = 5);",
                                "offset(0.5) difference() { square(3); square(1); }"};
  for (int round = 0; round < 30; ++round) {
    const std::string place = "translate([" + number(-1, 1) + ", " + number(-1, 1) + ", " + number(-1, 1) +
                              "]) rotate([" + number(0, 360) + ", " + number(0, 360) + ", " + number(0, 360) + "]) " +
                              (round % 3 == 0 ? "multmatrix([[1, 0.3, 0.2], [0, 1.2, 0], [0.1, 0, 0.9]]) " : "");
    const std::string sheared =
        "translate([0, 0, " + number(-3, 3) + "]) multmatrix([[1, 0.3, 0.2], [0, 1.2, 0.4], [0, 0, -0.9]]) ";
    const std::string cylinder = "cylinder(h = " + number(1, 5) + ", r1 = " + number(0.5, 3) +
                                 ", r2 = " + (round % 2 == 0 ? "0" : number(0.5, 3)) + ", center = true);";
    const std::string extrusion = "linear_extrude(" + number(1, 4) + ", scale = " + number(0, 2) + ", center = true) " +
                                  shapes[round % std::size(shapes)];
    expect_cut_is_of_solid(place + cylinder, random);
    expect_cut_is_of_solid(place + extrusion, random);
    expect_cut_is_of_solid(sheared + extrusion, random);
    // Of what lies on its side, or nearly.
    const std::string lying = "translate([0, 0, " + number(-1, 1) + "]) rotate([" +
                              (round % 5 == 0 ? std::string("90.000001") : std::string("90")) + ", " + number(0, 360) +
                              ", " + number(0, 360) + "]) ";
    expect_cut_is_of_solid(lying + extrusion, random);
    expect_cut_is_of_solid(lying + cylinder, random);
    expect_cut_is_of_solid(
        "translate([0, 0, " + number(-2, 2) + "]) rotate_extrude() translate([2, 0]) " + shapes[round % 3], random);
  }
}

TEST(CutProjection, AsksOtherSolids) {
  EXPECT_NEAR(area_of(outline_of("projection(cut = true) rotate([90, 0, 0]) paraboloid(h = 4, r = 2);")),
              2 * 2 * 4 * 2 / 3.0, 1e-4);
  Random random(8);
  expect_cut_is_of_solid("rotate([40, 0, 0]) torus(3, 1);", random);
  expect_cut_is_of_solid("rotate([40, 0, 0]) linear_extrude(3, twist = 100, center = true) square([3, 2]);", random);
}

TEST(ShadowProjection, IsExactOfUnions) {
  EXPECT_NEAR(area_of(outline_of("projection() translate([0, 0, 3]) sphere(5);")), 25 * pi, 1e-9);
  EXPECT_NEAR(area_of(outline_of("projection() rotate([0, 54.735610317245346, 0]) rotate([0, 0, 45]) cube(2);")),
              4 * std::sqrt(3.0), 1e-9);
  EXPECT_NEAR(area_of(outline_of("projection() rotate([0, 90, 0]) cylinder(h = 4, r1 = 1, r2 = 2);")), 12, 1e-5);
  EXPECT_NEAR(area_of(outline_of("projection() rotate([0, 30, 0]) cylinder(h = 4, r = 1);")),
              pi * std::cos(pi / 6) + 2 * 4 * 0.5, 1e-4);
  EXPECT_NEAR(area_of(outline_of("projection() { cube(2); translate([1, 1, 5]) cube(2); }")), 7, 1e-9);
}

TEST(ShadowProjection, IsExactOfWhatOperationsMakeOfPolyhedra) {
  EXPECT_NEAR(area_of(outline_of("projection() difference() { cube(2); translate([0, 0, 1]) cube(1); }")), 4, 1e-12);
  EXPECT_NEAR(
      area_of(outline_of("projection() rotate([0, 90, 0]) difference() { cube(4, center = true); cube([9, 2, 2], "
                         "center = true); translate([0, 0, 2]) cube([9, 2, 1], center = true); }")),
      16 - 4 - 1, 1e-12);
}

TEST(ShadowProjection, AsksOtherSolids) {
  EXPECT_NEAR(
      area_of(outline_of("projection() intersection() { sphere(2); translate([0, 0, 1]) cube([9, 9, 2], center = "
                         "true); }")),
      4 * pi, 1e-3);
  EXPECT_NEAR(area_of(outline_of("projection() torus(3, 1);")), 12 * pi, 1e-3);
}

TEST(Projection, SaysWhatItCannotDo) {
  EXPECT_NE(error_of("projection() halfspace();").find("without end"), std::string::npos);
  EXPECT_NE(warnings_of("projection() square(1); cube();").find("projection() takes solids"), std::string::npos);
  EXPECT_EQ(tree_of("projection(); cube();"), tree_of("cube();"));
}

}  // namespace
}  // namespace tenon
