// What modules make of outlines: offsets, hulls.
#include "lang/language.h"

namespace tenon {
namespace {

// The outline that a shape of the plane has become.
std::string outline_of(const std::string& text) {
  const std::string tree = tree_of("linear_extrude(1) " + text);
  const std::string before = "prism(outline = ", behind = ", h = 1, center = false, scale = 1);";
  const std::size_t begin = tree.find(before), end = tree.find(behind);
  if (begin == std::string::npos || end == std::string::npos) return tree;
  return tree.substr(begin + before.size(), end - begin - before.size());
}

TEST(OffsetModule, TakesARadiusOrADistance) {
  EXPECT_EQ(outline_of("offset(1) circle(2);"), "[[[0, -3, 1], [0, 3, 1]]]");
  EXPECT_EQ(outline_of("offset() circle(2);"), outline_of("offset(r = 1) circle(2);"));
  EXPECT_EQ(outline_of("offset(r = 1, delta = 5) circle(2);"), outline_of("offset(r = 1) circle(2);"));
  EXPECT_EQ(outline_of("offset(delta = -1) square(4);"), "[[[3, 3], [1, 3], [1, 1], [3, 1]]]");
  EXPECT_NE(outline_of("offset(delta = 1, chamfer = true) square(4);"), outline_of("offset(delta = 1) square(4);"));
  EXPECT_EQ(outline_of("offset(r = 1, chamfer = true) square(4);"), outline_of("offset(r = 1) square(4);"));
}

TEST(OffsetModule, SeesOperationsAsOneShape) {
  // Halves of a square have no seam, and what is cut away counts.
  EXPECT_EQ(outline_of("offset(delta = 1) { square([2, 4]); translate([2, 0]) square([2, 4]); }"),
            outline_of("offset(delta = 1) square(4);"));
  EXPECT_EQ(outline_of("offset(1) difference() { circle(4); circle(3); }"),
            "[[[0, -5, 1], [0, 5, 1]], [[0, -2, -1], [0, 2, -1]]]");
  EXPECT_EQ(outline_of("offset(1) color(\"red\") scale(2) rotate(90) circle(1);"), outline_of("offset(1) circle(2);"));
  EXPECT_NE(error_of("linear_extrude(1) offset(1) complement() circle(1);").find("a complement() has no outline"),
            std::string::npos);
}

TEST(OffsetModule, OfNothingIsNothing) {
  EXPECT_EQ(tree_of("linear_extrude(1) offset(-3) circle(2); cube();"), tree_of("cube();"));
  EXPECT_EQ(tree_of("linear_extrude(1) offset(1); cube();"), tree_of("cube();"));
  EXPECT_NE(warnings_of("offset(1) cube(); cube();").find("offset() takes shapes of the plane"), std::string::npos);
}

TEST(HullModule, OfShapesIsConvexAndExact) {
  EXPECT_EQ(outline_of("hull() { square(4); translate([1, 1]) circle(1); }"), "[[[0, 0], [4, 0], [4, 4], [0, 4]]]");
  EXPECT_EQ(outline_of("hull() difference() { circle(4); circle(3); }"), "[[[0, -4, 1], [0, 4, 1]]]");
  EXPECT_EQ(tree_of("linear_extrude(1) hull(); cube();"), tree_of("cube();"));
}

}  // namespace
}  // namespace tenon
