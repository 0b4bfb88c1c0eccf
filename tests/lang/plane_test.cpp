// What shapes of the plane and their extrusions make.
#include "lang/language.h"

namespace tenon {
namespace {

// The message of an error, without the line it points into.
std::string message_of(const std::string& text) {
  const std::string error = error_of(text);
  return error.substr(0, error.find('\n'));
}

const std::string thick10 = "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 10, 0], [0, 0, 0, 1]]) {\n";

TEST(LinearExtrude, OfACircleIsACylinder) {
  EXPECT_EQ(tree_of("linear_extrude(10) circle(3);"), thick10 + "\tcylinder(h = 1, r = 3, center = false);\n}\n");
  EXPECT_EQ(tree_of("linear_extrude(height = 10) circle(d = 6);"), tree_of("linear_extrude(10) circle(3);"));
  EXPECT_NE(tree_of("linear_extrude() circle(1);").find("[0, 0, 100, 0]"), std::string::npos);
  EXPECT_NE(tree_of("linear_extrude(8, center = true) circle(1);").find("[0, 0, 8, -4]"), std::string::npos);
}

TEST(LinearExtrude, OfADifferenceIsTheDifferenceOfTheExtrusions) {
  EXPECT_EQ(tree_of("linear_extrude(10) difference() { square([4, 2]); circle(1); }"),
            thick10 +
                "\tdifference() {\n"
                "\t\tcube(size = [4, 2, 1], center = false);\n"
                "\t\tcylinder(h = 1, r = 1, center = false);\n"
                "\t}\n}\n");
}

TEST(LinearExtrude, KeepsTransformationsInThePlane) {
  EXPECT_EQ(tree_of("linear_extrude(10) translate([1, 2, 3]) circle(1);"),
            thick10 +
                "\tmultmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n"
                "\t\tcylinder(h = 1, r = 1, center = false);\n\t}\n}\n");
  // Turned over, a shape is mirrored.
  EXPECT_NE(
      tree_of("linear_extrude(10) rotate([180, 0, 0]) square();").find("[[1, 0, 0, 0], [0, -1, 0, 0], [0, 0, 1, 0]"),
      std::string::npos);
  EXPECT_NE(warnings_of("linear_extrude(10) rotate([90, 0, 0]) square(); cube();").find("flattens its children"),
            std::string::npos);
  EXPECT_NE(tree_of("linear_extrude(10) resize([4, 0], auto = true) square([1, 2]);")
                .find("[[4, 0, 0, 0], [0, 4, 0, 0], [0, 0, 1, 0]"),
            std::string::npos);
}

TEST(LinearExtrude, ScaledMakesConesAndPrismsThatTaper) {
  const std::string tree =
      tree_of("linear_extrude(10, scale = 0.5) { circle(2); translate([4, 2]) polygon([[0, 0], [1, 0], [0, 1]]); }");
  EXPECT_NE(tree.find("cylinder(h = 1, r1 = 2, r2 = 1, center = false)"), std::string::npos) << tree;
  // What stands aside leans inward: at the top it is half as far out.
  EXPECT_NE(tree.find("[[1, 0, -2, 4], [0, 1, -1, 2], [0, 0, 1, 0]"), std::string::npos) << tree;
  EXPECT_NE(tree.find("prism(outline = [[[0, 0], [1, 0], [0, 1]]], h = 1, center = false, scale = 0.5)"),
            std::string::npos)
      << tree;
}

TEST(LinearExtrude, TwistedMovesTheOutlinesThatTurn) {
  const std::string tree = tree_of(
      "linear_extrude(10, twist = 90, scale = [1, 0.5]) translate([1, 2]) mirror([1, 0]) { circle(2); square(1); }");
  EXPECT_NE(
      tree.find("twisted_prism(outline = [[[1, 0, -1], [1, 4, -1]]], h = 1, center = false, twist = 90, scale_x = 1, "
                "scale_y = 0.5)"),
      std::string::npos)
      << tree;
  EXPECT_NE(tree.find("outline = [[[1, 2], [0, 2], [0, 3], [1, 3]]]"), std::string::npos) << tree;
  EXPECT_NE(warnings_of("linear_extrude(10, twist = 90, slices = 4) square();").find("'slices' is ignored"),
            std::string::npos);
  EXPECT_EQ(warnings_of("linear_extrude(10, twist = 90, slices = 40) square();"), "");
  EXPECT_NE(tree_of("linear_extrude(10, twist = 90, scale = 0) square();").find("scale_x = 0, scale_y = 0"),
            std::string::npos);
}

TEST(LinearExtrude, TwistsOperationsOnSegmentsAsOneOutline) {
  const auto count = [](const std::string& text, const std::string& word) {
    std::size_t found = 0;
    for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++found;
    return found;
  };
  const std::string one = tree_of(
      "linear_extrude(10, twist = 90) { square(2); translate([1, 0]) square(2); translate([8, 8]) square(1); }");
  EXPECT_EQ(count(one, "twisted_prism"), 1u) << one;
  EXPECT_NE(one.find("[[9, 9], [8, 9], [8, 8], [9, 8]], [[0, 0], [3, 0], [3, 2], [0, 2]]"), std::string::npos) << one;
  // Arcs stay exact, and what has a colour keeps it.
  EXPECT_EQ(
      count(
          tree_of("linear_extrude(10, twist = 90) difference() { circle(3); union() { square(4); square(5, true); } }"),
          "twisted_prism"),
      2u);
  EXPECT_EQ(count(tree_of("linear_extrude(10, twist = 90) { square(2); color(\"red\") square(3); }"), "twisted_prism"),
            2u);
  EXPECT_EQ(tree_of("linear_extrude(10, twist = 90) difference() { square(2); square(3); }").find("twisted_prism"),
            std::string::npos);
}

TEST(LinearExtrude, SaysWhatItCannotDo) {
  EXPECT_NE(message_of("linear_extrude(10, twist = 1e6) square();").find("twists end at 360000 degrees"),
            std::string::npos);
  EXPECT_EQ(message_of("linear_extrude(10, scale = -1) square();"),
            "scene.scad:1:20: error: 'scale' must be at least 0");
  EXPECT_NE(warnings_of("linear_extrude(10) cube(); cube();").find("its children are solids"), std::string::npos);
  EXPECT_NE(warnings_of("linear_extrude(0) square(); cube();").find("has no volume"), std::string::npos);
}

TEST(RotateExtrude, KeepsArcs) {
  EXPECT_EQ(tree_of("rotate_extrude() translate([5, 0]) circle(1);"), "torus(R = 5, r = 1);\n");
  EXPECT_EQ(
      tree_of(
          "rotate_extrude() difference() { translate([1, 0]) square(2); translate([3, 1]) mirror([1, 0]) circle(1); }"),
      "difference() {\n"
      "\trevolution(outline = [[[1, 0], [3, 0], [3, 2], [1, 2]]]);\n"
      "\tmultmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 1], [0, 0, 0, 1]]) {\n"
      "\t\ttorus(R = 3, r = 1);\n"
      "\t}\n"
      "}\n");
  // What is uneven along the axes is so after the turn.
  EXPECT_EQ(tree_of("rotate_extrude() scale([1, 0.5]) translate([5, 0]) circle(1);"),
            "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0.5, 0], [0, 0, 0, 1]]) {\n"
            "\ttorus(R = 5, r = 1);\n"
            "}\n");
  EXPECT_NE(error_of("rotate_extrude() translate([5, 0]) rotate(30) scale([1, 2]) circle(1);")
                .find("rotate_extrude() of an ellipse whose axes are turned is not supported yet"),
            std::string::npos);
}

TEST(RotateExtrude, CutsAtTheAxis) {
  EXPECT_EQ(tree_of("rotate_extrude() intersection() { circle(2); square(3); }"),
            "intersection() {\n"
            "\trevolution(outline = [[[0, -2, 1], [0, 2]]]);\n"
            "\trevolution(outline = [[[0, 0], [3, 0], [3, 3], [0, 3]]]);\n"
            "}\n");
  EXPECT_EQ(tree_of("rotate_extrude() polygon([[-1, 0], [1, 0], [1, 2]]);"),
            "revolution(outline = [[[0, 0], [1, 0], [1, 2], [0, 1]]]);\n");
  EXPECT_NE(warnings_of("rotate_extrude() square(2, center = true);").find("what lies left of it is cut off"),
            std::string::npos);
  EXPECT_EQ(warnings_of("rotate_extrude() intersection() { circle(2); square(3); }"), "");
  // The outline begins right of the axis, at [5, 0], and comes back there.
  EXPECT_EQ(tree_of("rotate_extrude() translate([2, 0]) polygon([[3, 0], [-3, 4], [-3, -4]]);"),
            "revolution(outline = [[[5, 0], [0, 3.3333333333333335], [0, -3.3333333333333335]]]);\n");
  // Arcs that end on the axis on their way towards it, and arcs that touch it, do not reach over it.
  EXPECT_EQ(tree_of("rotate_extrude() translate([3, 0]) circle(5);").substr(0, 33),
            "revolution(outline = [[[3, -5, 1]");
  const std::string rounded = "rotate_extrude() offset(r = 1) translate([1, 1]) square([5, 5]);";
  EXPECT_NE(tree_of(rounded).find("revolution"), std::string::npos);
  EXPECT_EQ(warnings_of(rounded), "");
  // Left of the axis as a whole: the same solid.
  EXPECT_EQ(tree_of("rotate_extrude() translate([-3, 0]) square(1);"),
            "revolution(outline = [[[3, 0], [2, 0], [2, 1], [3, 1]]]);\n");
}

TEST(RotateExtrude, ByAnAngleIsAPieceOfCake) {
  const std::string quarter = tree_of("rotate_extrude(angle = 90) translate([1, 0]) square(1);");
  EXPECT_NE(quarter.find("intersection() {\n\trevolution("), std::string::npos) << quarter;
  EXPECT_NE(quarter.find("prism(outline = [[[0, 0], [4"), std::string::npos) << quarter;
  EXPECT_EQ(tree_of("rotate_extrude(angle = -400) translate([1, 0]) square(1);"),
            tree_of("rotate_extrude() translate([1, 0]) square(1);"));
  EXPECT_NE(warnings_of("rotate_extrude(angle = 0) square(1);").find("has no volume"), std::string::npos);
}

TEST(Polygon, TakesPointsAndPaths) {
  EXPECT_EQ(tree_of("linear_extrude(10) polygon([[0, 0], [2, 0], [0, 2]]);"),
            thick10 + "\tprism(outline = [[[0, 0], [2, 0], [0, 2]]], h = 1, center = false, scale = 1);\n}\n");
  const std::string points = "[[0, 0], [9, 0], [0, 9], [1, 1], [2, 1], [1, 2]]";
  EXPECT_NE(tree_of("linear_extrude(10) polygon(" + points + ", [[0, 1, 2], [3, 4, 5]]);")
                .find("[[[0, 0], [9, 0], [0, 9]], [[1, 1], [2, 1], [1, 2]]]"),
            std::string::npos);
  EXPECT_NE(tree_of("linear_extrude(10) polygon(" + points + ", [0, 1, 2]);").find("[[[0, 0], [9, 0], [0, 9]]]"),
            std::string::npos);
  EXPECT_EQ(message_of("polygon([[0, 0], [1]]);"),
            "scene.scad:1:9: error: point 1 of the polygon is no list of two finite numbers");
  EXPECT_EQ(message_of("polygon([[0, 0], [1, 0], [0, 1]], [[0, 1, 3]]);"),
            "scene.scad:1:35: error: path 0 of the polygon is no list of indices from 0 to 3 - 1");
  EXPECT_NE(warnings_of("polygon([[0, 0], [1, 1]]); cube();").find("encloses nothing"), std::string::npos);
}

TEST(Circle, WithFewFacetsIsAPolygon) {
  EXPECT_NE(tree_of("linear_extrude(10) circle(1, $fn = 4);").find("[[[1, 0], [0, 1], [-1, 0], [0, -1]]]"),
            std::string::npos);
}

TEST(Shapes, DoNotMixWithSolids) {
  EXPECT_EQ(tree_of("cube(2); square(3);"), tree_of("cube(2);"));
  EXPECT_NE(
      warnings_of("cube(2); square(3);").find("scene.scad:1:10: warning: a shape of the plane stands beside solids"),
      std::string::npos);
  EXPECT_NE(
      warnings_of("linear_extrude(2) { square(3); sphere(1); }").find("a solid stands beside shapes of the plane"),
      std::string::npos);
}

TEST(Shapes, AloneAreDrawnThin) {
  EXPECT_EQ(tree_of("circle(2);"),
            "multmatrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -0.5], [0, 0, 0, 1]]) {\n"
            "\tcylinder(h = 1, r = 2, center = false);\n}\n");
  EXPECT_NE(warnings_of("circle(2);").find("it is drawn 1 thick"), std::string::npos);
}

}  // namespace
}  // namespace tenon
