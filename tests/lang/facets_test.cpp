// What OpenSCAD makes facets of, by a description of its own: between two copies of a profile that is turned, the solid
// is the profile drawn nearer to the axis and swept straight.
#include <cmath>

#include "lang/convex_solid.h"
#include "math/vec2.h"
#include "tenon/math/affine3.h"

namespace tenon {
namespace {

using Profile = std::vector<Vec2>;

std::string text_of(const Profile& profile) {
  std::ostringstream out;
  out.precision(17);
  out << "polygon([";
  for (const Vec2& p : profile) out << '[' << p.x << ", " << p.y << "],";
  out << "])";
  return out.str();
}

bool is_inside(const Profile& profile, const Vec2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const Vec2 &a = profile[i], &b = profile[(i + 1) % profile.size()];
    if ((a.y > p.y) == (b.y > p.y)) continue;
    inside ^= p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y);
  }
  return inside;
}

/// A profile turned from an angle on, through another, in so many steps.
struct Turned {
  Profile profile;
  double from, through;
  int steps;

  bool holds(const Vec3& p) const {
    const double step = through / steps;
    const double angle = std::atan2(p.y, p.x) * (180 / M_PI);
    double along = std::fmod((angle - from) * (through < 0 ? -1 : 1), 360.0);
    if (along < 0) along += 360;
    if (along > std::fabs(through)) return false;
    const double middle = from + step * (std::floor(along / std::fabs(step)) + 0.5);
    const double distance = (p.x * cos_degrees(middle) + p.y * sin_degrees(middle)) / cos_degrees(step / 2);
    return is_inside(profile, {distance, p.z});
  }
};

void expect_same(const UnionScene& scene, const Turned& turned, const std::string& what) {
  Random random(31);
  int inside = 0, wrong = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p{random.uniform(-7, 7), random.uniform(-7, 7), random.uniform(-1, 5)};
    bool found = false;
    for (const SolidSpan& span : scene.spans({p, random.direction()})) {
      found |= span.t_in <= 0 && span.t_out > 0;
    }
    inside += turned.holds(p);
    wrong += found != turned.holds(p);
  }
  EXPECT_EQ(wrong, 0) << what;
  EXPECT_GT(inside, 30) << what;
}

std::string in_facets(const std::string& text) {
  return tree_of(text, {Facets::always, {}});
}

// The points of a polyhedron's text.
std::vector<Vec3> points_of(const std::string& tree) {
  std::vector<Vec3> points;
  std::istringstream in(tree.substr(tree.find("points = [") + 10));
  char c = 0;
  for (Vec3 p; in >> c && c == '[' && in >> p.x >> c >> p.y >> c >> p.z >> c;) {
    points.push_back(p);
    in >> c;
    if (c == ']') break;
  }
  return points;
}

const Profile ring{{3, 0}, {6, 0}, {6, 1}, {4, 1.5}, {6, 3}, {3, 4}};
const Profile top{{0, 0}, {5, 0}, {2, 2}, {5, 3}, {0, 4}};

TEST(RotateExtrude, HasFacetsWhereTheyAreMeant) {
  for (const Profile& profile : {ring, top}) {
    for (const int n : {3, 4, 5, 8, 12}) {
      const std::string scene = "rotate_extrude($fn = " + std::to_string(n) + ") " + text_of(profile) + ";";
      expect_same(UnionScene(scene), {profile, 180, 360, n}, scene);
    }
  }
  // Left of the axis copies begin on the other side.
  expect_same(UnionScene("rotate_extrude($fn = 5) mirror([1, 0]) " + text_of(ring) + ";"), {ring, 0, 360, 5},
              "mirrored");
  // As many as belong to a part of the circle, at least one; half a circle and more takes two.
  for (const auto& [angle, steps] : {std::pair{90, 2}, {-100, 2}, {30, 1}, {200, 4}, {-350, 7}}) {
    const std::string scene = "rotate_extrude($fn = 8, angle = " + std::to_string(angle) + ") ";
    const Turned turned{ring, 0, static_cast<double>(angle), steps};
    expect_same(UnionScene(scene + text_of(ring) + ";"), turned, scene);
    const Turned across{ring, 180, static_cast<double>(angle), steps};
    expect_same(UnionScene(scene + "mirror([1, 0]) " + text_of(ring) + ";"), across, scene + "mirrored");
  }
  expect_same(UnionScene("rotate_extrude($fn = 3, angle = 200) " + text_of(ring) + ";"), {ring, 0, 200, 2}, "few");
}

// Rounding leaves a corner of the axis beside it: there shall be no hole as wide as that.
TEST(RotateExtrude, HasFacetsThatMeetOnTheAxis) {
  const std::string profile = "translate([0.1 + 0.2 - 0.3, 0]) polygon([[0, 0], [2, 0], [1, 1], [2, 3], [0, 3]]);";
  const auto spans = UnionScene("rotate_extrude($fn = 9) " + profile).spans({{0, 0, 10}, {0, 0, -1}});
  ASSERT_EQ(spans.size(), 1u);
  EXPECT_EQ(spans.front(), (SolidSpan{7, 10}));
}

TEST(RotateExtrude, CountsTheFacetsOfAPart) {
  const auto copies = [](const std::string& of) {
    const std::string scene = "$fn = 45; rotate_extrude(angle = " + of + ") translate([5, 0]) square(1);";
    const std::vector<Vec3> points = points_of(in_facets(scene));
    // Four corners a copy; what closes the circle takes two facets more.
    return points.size() / 4;
  };
  EXPECT_EQ(copies("104"), 13u + 2);
  EXPECT_EQ(copies("360"), 45u);
}

TEST(RotateExtrude, StaysRoundWhereTheShapeIs) {
  const std::string scene = "rotate_extrude($fn = 8) translate([5, 0]) circle(1, $fn = 40);";
  EXPECT_EQ(tree_of(scene), "torus(R = 5, r = 1);\n");
  EXPECT_NE(warnings_of(scene).find("round here, for the shape has arcs"), std::string::npos);
  EXPECT_EQ(warnings_of("rotate_extrude($fn = 40) translate([5, 0]) circle(1);"), "");
}

TEST(RotateExtrude, GoesAllAroundByAnAngleThatIsNone) {
  const std::string whole = tree_of("rotate_extrude() translate([1, 0]) square(1);");
  for (const char* angle : {"0 / 0", "1 / 0", "-1 / 0"}) {
    const std::string scene = "rotate_extrude(angle = " + std::string(angle) + ") translate([1, 0]) square(1);";
    EXPECT_EQ(tree_of(scene), whole);
    EXPECT_NE(warnings_of(scene).find("goes all around with angle = "), std::string::npos);
  }
}

// What has many facets is a mesh, whose time a ray does not grow with their number.
TEST(Facets, ManyAreAMesh) {
  const std::vector<Vec3> sphere = points_of(in_facets("sphere(10);"));
  // 30 facets around, in 15 rings, and a point in the middle of both ends.
  EXPECT_EQ(sphere.size(), 30u * 15 + 2);
  int on_sphere = 0;
  for (const Vec3& p : sphere) on_sphere += std::fabs(length(p) - 10) < 1e-12;
  EXPECT_EQ(on_sphere, 30 * 15);

  const std::vector<Vec3> cone = points_of(in_facets("cylinder(h = 5, r1 = 10, r2 = 4, center = true, $fn = 40);"));
  EXPECT_EQ(cone.size(), 2u * 40 + 2);
  for (const Vec3& p : cone) {
    const double r = std::hypot(p.x, p.y);
    EXPECT_TRUE(r == 0 || std::fabs(r - (p.z < 0 ? 10 : 4)) < 1e-12) << r;
    EXPECT_EQ(std::fabs(p.z), 2.5);
  }
  EXPECT_EQ(points_of(in_facets("cylinder(h = 5, r1 = 10, r2 = 0, $fn = 40);")).size(), 40u + 2);
}

}  // namespace
}  // namespace tenon
