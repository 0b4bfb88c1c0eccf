// Solids with flat faces as unions of convex polyhedra, against the solids themselves.
#include "lang/polyhedral_parts.h"

#include "lang/convex_solid.h"

namespace tenon {
namespace {

using lang::polyhedral_parts;

std::vector<ConvexCell> parts_of(const std::string& text) {
  const Outcome outcome = evaluate(text, {Facets::always, {}});
  EXPECT_TRUE(outcome.model.ok()) << (outcome.model ? "" : format_error(outcome.model.error()));
  const auto parts = polyhedral_parts(outcome.model->graph, outcome.model->graph.root, {});
  EXPECT_TRUE(parts.has_value()) << text;
  return parts.value_or(std::vector<ConvexCell>{});
}

bool holds(const ConvexCell& part, const Vec3& p) {
  return std::all_of(part.faces().begin(), part.faces().end(),
                     [&](const FlatPolygon& face) { return dot(face.plane.normal, p) <= face.plane.d; });
}

// Each place of the solid belongs to one part, and no other place does.
void expect_parts(const std::string& text, std::size_t most) {
  SCOPED_TRACE(text);
  const std::vector<ConvexCell> parts = parts_of(text);
  EXPECT_LE(parts.size(), most);
  const UnionScene scene(tree_of(text, {Facets::always, {}}));
  Random random(11);
  int inside = 0, wrong = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p{random.uniform(-6, 6), random.uniform(-6, 6), random.uniform(-6, 6)};
    bool found = false;
    for (const SolidSpan& span : scene.spans({p, {0.3, 0.4, 1}})) found |= span.t_in <= 0 && span.t_out > 0;
    const auto count =
        std::count_if(parts.begin(), parts.end(), [&](const ConvexCell& part) { return holds(part, p); });
    inside += found;
    wrong += count != (found ? 1 : 0);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(inside, 20);
}

TEST(PolyhedralParts, AreTheSolidAndDisjoint) {
  expect_parts("difference() { cube(10, center = true); cube(6, center = true); }", 6);
  expect_parts("difference() { cube(10, center = true); translate([0, 0, 2]) cube(6, center = true); }", 5);
  expect_parts("intersection() { cube(8, center = true); rotate([45, 35, 0]) cube(8, center = true); }", 1);
  expect_parts(
      "difference() { rotate([10, 20, 30]) cube(9, center = true); rotate([40, 0, 10]) cylinder(h = 20, r = 2, $fn = "
      "6, center = true); rotate([0, 90, 10]) cylinder(h = 20, r = 3, $fn = 5, center = true); }",
      60);
  // Faces that lie in one another.
  expect_parts("difference() { translate([-5, -5, -5]) cube(10); translate([-5, -5, -5]) cube(5); cube(5); }", 8);
}

TEST(PolyhedralParts, OfWhatIsNotConvexByItself) {
  expect_parts("linear_extrude(8, center = true) polygon([[-5, -5], [5, -5], [5, 5], [0, 0], [-5, 5]]);", 3);
  expect_parts(
      "rotate([20, 30, 0]) linear_extrude(6, scale = 0.3) difference() { square(9, center = true); "
      "square(4, center = true); }",
      8);
  expect_parts(
      "difference() { linear_extrude(9, center = true) difference() { square(9, center = true); square(5, "
      "center = true); } rotate([90, 0, 0]) linear_extrude(30, center = true) polygon([[-4, 0], [4, 0], [1, "
      "1], [0, 4]]); }",
      40);
  // A mesh: facets of a ring, and one that is mirrored.
  const std::string ring = "rotate_extrude($fn = 6) translate([3, 0]) polygon([[0, -1], [2, -2], [1, 0], [2, 2]]);";
  expect_parts(ring, 60);
  expect_parts("mirror([1, 1, 0]) difference() { " + ring + " cube(4); }", 120);
}

/// Boxes and wedges of whole numbers, many of whose faces lie in one another.
std::string random_solid(Random& random, int depth) {
  const auto whole = [&](int low, int high) { return std::to_string(random.below(high - low + 1) + low); };
  if (depth == 0) {
    const std::string place = "translate([" + whole(-5, 2) + ", " + whole(-5, 2) + ", " + whole(-5, 2) +
                              "]) rotate([0, 0, " + (random.below(4) == 0 ? "30" : "90") + "]) ";
    const std::string box = "cube([" + whole(1, 6) + ", " + whole(1, 6) + ", " + whole(1, 6) + "]);";
    const std::string wedge = "linear_extrude(" + whole(1, 6) + ") polygon([[0, 0], [4, 0], [1, 1], [0, 5]]);";
    return place + (random.below(3) == 0 ? wedge : box);
  }
  const std::string operations[] = {"difference() { ", "difference() { ", "intersection() { "};
  std::string text =
      operations[random.below(3)] + random_solid(random, depth - 1) + " " + random_solid(random, depth - 1);
  if (random.below(2) == 0) text += " " + random_solid(random, depth - 1);
  return text + " }";
}

TEST(PolyhedralParts, AreTheSolidWhereFacesCoincide) {
  Random random(17);
  for (int round = 0; round < 40; ++round) {
    // Of the box something is left.
    expect_parts("difference() { cube(12, center = true); " + random_solid(random, 2) + " }", 400);
  }
}

TEST(PolyhedralParts, AreNotOfWhatIsRound) {
  const Outcome outcome = evaluate("difference() { cube(4, center = true); sphere(1); }");
  EXPECT_FALSE(polyhedral_parts(outcome.model->graph, outcome.model->graph.root, {}).has_value());
}

// The length of the solid along lines across a box is its volume.
double volume_of(const std::string& text, double half) {
  const UnionScene scene(text);
  constexpr int lines = 60;
  double sum = 0;
  for (int x = 0; x < lines; ++x) {
    for (int y = 0; y < lines; ++y) {
      const Vec3 from{half * ((2 * x + 1.0) / lines - 1), half * ((2 * y + 1.0) / lines - 1), -2 * half};
      for (const SolidSpan& span : scene.spans({from, {0, 0, 1}})) sum += span.t_out - span.t_in;
    }
  }
  return sum * 4 * half * half / (lines * lines);
}

TEST(Minkowski, OfDifferencesOfSolidsWithFlatFaces) {
  EXPECT_NEAR(volume_of("minkowski() { difference() { cube(19, center = true); cube(11, center = true); } cube(1, "
                        "center = true); }",
                        15),
              20 * 20 * 20 - 10 * 10 * 10, 1e-6);
  EXPECT_NEAR(volume_of("minkowski() { difference() { cube(8, center = true); cube(9); } sphere(1); }", 6),
              // The body with an eighth taken out is the union of three slabs.
              volume_of("minkowski() { translate([-4, -4, -4]) cube([8, 8, 4]); sphere(1); }"
                        "minkowski() { translate([-4, -4, -4]) cube([8, 4, 8]); sphere(1); }"
                        "minkowski() { translate([-4, -4, -4]) cube([4, 8, 8]); sphere(1); }",
                        6),
              1e-9);
  EXPECT_EQ(tree_of("minkowski() { intersection() { cube(1); translate([2, 0, 0]) cube(1); } cube(1); } cube(3);"),
            tree_of("cube(3);"));
}

TEST(Polyhedron, MayNamePointsThatNoFaceHas) {
  const std::string faces = "], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]]);";
  const std::string corners = "polyhedron([[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]";
  EXPECT_NE(tree_of(corners + faces).find("convex_polyhedron"), std::string::npos);
  EXPECT_EQ(tree_of(corners + ", [9, 9, 9]" + faces), tree_of(corners + faces));
}

// Faces of one zone have edges that are parallel but for rounding.
TEST(Minkowski, OfBoxesThatAreTurned) {
  Random random(5);
  const auto turned = [&](const Vec3& size, std::vector<Vec3>& corners) {
    const Vec3 angles{static_cast<double>(random.below(360)), static_cast<double>(random.below(360)),
                      static_cast<double>(random.below(360))};
    for (int i = 0; i < 8; ++i) {
      corners.push_back(Affine3::rotate(angles).point(
          {(i & 1) != 0 ? size.x : 0, (i & 2) != 0 ? size.y : 0, (i & 4) != 0 ? size.z : 0}));
    }
    std::ostringstream out;
    out << "rotate([" << angles.x << ", " << angles.y << ", " << angles.z << "]) cube([" << size.x << ", " << size.y
        << ", " << size.z << "]);";
    return out.str();
  };
  for (int round = 0; round < 25; ++round) {
    std::vector<Vec3> a, b;
    const std::string first = turned({7, 2, 5}, a), second = turned({0.75, 0.25, 1}, b);
    std::vector<SpanningBall> sums;
    for (const Vec3& p : a) {
      for (const Vec3& q : b) sums.push_back({p + q, 0});
    }
    const std::string text = "minkowski() { " + first + " " + second + " }";
    EXPECT_EQ(warnings_of(text), "") << text;
    expect_hull(text, sums, random, 1e-9);  // bounds of vertices are generous
  }
}

TEST(Minkowski, OfTwoSolidsThatAreNotConvex) {
  // Each part of the one with each of the other: an L and an L.
  const std::string ell =
      "rotate([0, 0, 20]) rotate([90, 0, 0]) linear_extrude(1) polygon([[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, "
      "2]]);";
  const std::string bars[] = {"rotate([0, 0, 20]) rotate([90, 0, 0]) cube([2, 1, 1]);",
                              "rotate([0, 0, 20]) rotate([90, 0, 0]) cube([1, 2, 1]);"};
  const std::string other = "rotate([30, 0, 0]) linear_extrude(2) polygon([[0, 0], [2, 0], [1, 1], [2, 2], [0, 2]]);";
  const std::string halves[] = {"rotate([30, 0, 0]) linear_extrude(2) polygon([[0, 0], [2, 0], [1, 1], [0, 1]]);",
                                "rotate([30, 0, 0]) linear_extrude(2) polygon([[0, 1], [1, 1], [2, 2], [0, 2]]);"};
  std::string parts;
  for (const std::string& bar : bars) {
    for (const std::string& half : halves) parts += "minkowski() { " + bar + " " + half + " }";
  }
  EXPECT_NEAR(volume_of("minkowski() { " + ell + " " + other + " }", 6), volume_of(parts, 6), 1e-9);
}

TEST(Hull, OfDifferencesOfSolidsWithFlatFaces) {
  EXPECT_NEAR(volume_of("hull() difference() { cube(8, center = true); translate([0, 0, 2]) cube([9, 9, 5], center = "
                        "true); rotate([90, 0, 0]) cylinder(h = 20, r = 1, $fn = 6, center = true); }",
                        6),
              8 * 8 * 3.5, 1e-6);
}

}  // namespace
}  // namespace tenon
