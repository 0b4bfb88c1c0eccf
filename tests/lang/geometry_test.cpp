// What statements make of solids. The expectations on empty operands were checked against OpenSCAD 2021.01.
#include "lang/language.h"

namespace tenon {
namespace {

const std::string cube2 = "cube(size = [2, 2, 2], center = false);\n";

TEST(Operations, AnIfWithoutSolidIsNoOperand) {
  EXPECT_EQ(tree_of("difference() { if (false) cube(); cube(2); }"), cube2);
  EXPECT_EQ(tree_of("intersection() { if (false) cube(); cube(2); }"), cube2);
  EXPECT_EQ(tree_of("difference() { echo(1); assert(true); *cube(); %cube(); cube(2); }"), cube2);
}

TEST(Operations, AnEmptyGroupIsAnOperand) {
  for (const char* empty : {"union() {}", "for (i = []) cube();", "group();", "nothing();", "cube(0);", "sphere(-1);",
                            "intersection_for (i = []) cube();", "if (true) {}"}) {
    const std::string prefix = "module nothing() {} ";
    EXPECT_EQ(tree_of(prefix + "difference() { " + empty + " cube(2); }"), "") << empty;
    EXPECT_EQ(tree_of(prefix + "intersection() { " + empty + " cube(2); }"), "") << empty;
    EXPECT_EQ(tree_of(prefix + "difference() { cube(2); " + empty + " }"), cube2) << empty;
    EXPECT_EQ(tree_of(prefix + "union() { cube(2); " + empty + " }"), cube2) << empty;
  }
}

TEST(Operations, AForIsOneOperand) {
  EXPECT_EQ(tree_of("difference() { for (i = [1:2]) cube(i); cube(3); }"),
            "difference() {\n"
            "\tunion() {\n"
            "\t\tcube(size = [1, 1, 1], center = false);\n"
            "\t\tcube(size = [2, 2, 2], center = false);\n"
            "\t}\n"
            "\tcube(size = [3, 3, 3], center = false);\n"
            "}\n");
}

TEST(Operations, EveryChildOfAnIntersectionForIsAnOperand) {
  EXPECT_EQ(tree_of("intersection_for (i = [1:2]) { cube(i); sphere(i); }"),
            "intersection() {\n"
            "\tcube(size = [1, 1, 1], center = false);\n"
            "\tsphere(r = 1);\n"
            "\tcube(size = [2, 2, 2], center = false);\n"
            "\tsphere(r = 2);\n"
            "}\n");
}

TEST(Operations, ComplementsFoldAway) {
  EXPECT_EQ(tree_of("complement() complement() union() {}"), "");
  EXPECT_EQ(tree_of("intersection() { cube(2); complement() union() {} }"), cube2);
  EXPECT_EQ(tree_of("difference() { cube(2); complement() union() {} }"), "");
  EXPECT_EQ(tree_of("difference() { complement() union() {} cube(2); }"), "complement() {\n\t" + cube2 + "}\n");
  EXPECT_NE(error_of("complement() union() {}").find("all of space"), std::string::npos);
}

TEST(Modifiers, RootDisableBackgroundAndHighlight) {
  EXPECT_EQ(tree_of("sphere(3); translate([1, 2, 3]) !cube(2);"), cube2);
  EXPECT_EQ(tree_of("%sphere(3); *sphere(4); #cube(2);"), cube2);
  EXPECT_NE(warnings_of("!cube(2); !cube(3);").find("more than one '!'"), std::string::npos);
}

TEST(Modules, ChildrenAreOneGroup) {
  EXPECT_EQ(tree_of("module m() { difference() { children(); cube(2); } } m() { cube(1); sphere(1); }"),
            "difference() {\n"
            "\tunion() {\n"
            "\t\tcube(size = [1, 1, 1], center = false);\n"
            "\t\tsphere(r = 1);\n"
            "\t}\n"
            "\tcube(size = [2, 2, 2], center = false);\n"
            "}\n");
}

TEST(Modules, ChildIsOneOfTheChildren) {
  EXPECT_EQ(tree_of("module m() child(); m() { cube(2); sphere(1); }"), cube2);
  EXPECT_EQ(tree_of("module m() child(1); m() { sphere(1); cube(2); }"), cube2);
  EXPECT_NE(warnings_of("module m() child(2); m() { cube(2); sphere(1); } cube();").find("there is no child 2"),
            std::string::npos);
}

TEST(Modules, UsersOwnHideTheBuiltIn) {
  EXPECT_EQ(tree_of("module torus() cube(2); torus();"), cube2);
  EXPECT_EQ(tree_of("include <tenon.scad>\nuse <some/folder/tenon.scad>\nmodule sphere() cube(2); sphere();"), cube2);
}

TEST(Transforms, MatricesAreOpenscads) {
  const auto matrix = [](const std::string& rows) {
    return "multmatrix([" + rows + ", [0, 0, 0, 1]]) {\n\t" + cube2 + "}\n";
  };
  EXPECT_EQ(tree_of("translate([1, 2]) cube(2);"), matrix("[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 0]"));
  EXPECT_EQ(tree_of("scale([1, 2]) cube(2);"), matrix("[1, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0]"));
  EXPECT_EQ(tree_of("scale(3) cube(2);"), matrix("[3, 0, 0, 0], [0, 3, 0, 0], [0, 0, 3, 0]"));
  EXPECT_EQ(tree_of("rotate(90) cube(2);"), matrix("[0, -1, 0, 0], [1, 0, 0, 0], [0, 0, 1, 0]"));
  EXPECT_EQ(tree_of("rotate([90]) cube(2);"), matrix("[1, 0, 0, 0], [0, 0, -1, 0], [0, 1, 0, 0]"));
  EXPECT_EQ(tree_of("rotate(90, [0, 1]) cube(2);"), matrix("[0, 0, 1, 0], [0, 1, 0, 0], [-1, 0, 0, 0]"));
  EXPECT_EQ(tree_of("mirror([1, 0, 0]) cube(2);"), matrix("[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]"));
  EXPECT_EQ(tree_of("multmatrix([[2, 0, 0, 4], [0, 2, 0, 0], [0, 0, 2, 0], [0, 0, 0, 2]]) cube(2);"),
            matrix("[1, 0, 0, 2], [0, 1, 0, 0], [0, 0, 1, 0]"));
}

TEST(Transforms, FlatteningLeavesNoSolid) {
  for (const char* flat : {"scale(0)", "scale([1, 0, 1])", "multmatrix([[1, 0, 0], [0, 0, 0], [0, 0, 1]])"}) {
    EXPECT_EQ(tree_of(std::string(flat) + " cube(2);"), "");
    EXPECT_NE(warnings_of(std::string(flat) + " cube(2);").find("scene.scad:1:1: warning: "), std::string::npos);
  }
}

TEST(Resize, ScalesByTheExactBounds) {
  const auto scaled = [](const std::string& x, const std::string& y, const std::string& z, const std::string& solid) {
    return "multmatrix([[" + x + ", 0, 0, 0], [0, " + y + ", 0, 0], [0, 0, " + z + ", 0], [0, 0, 0, 1]]) {\n\t" +
           solid + "}\n";
  };
  EXPECT_EQ(tree_of("resize([3, 0, 0]) cube(2);"), scaled("1.5", "1", "1", cube2));
  EXPECT_EQ(tree_of("resize([3, 0, 0], auto = true) cube(2);"), scaled("1.5", "1.5", "1.5", cube2));
  EXPECT_EQ(tree_of("resize([3, 0, 6], auto = true) cube(2);"), scaled("1.5", "3", "3", cube2));
  EXPECT_EQ(tree_of("resize([3, 0, 6], auto = [false, false, true]) cube(2);"), scaled("1.5", "1", "3", cube2));
  EXPECT_EQ(tree_of("resize([-3, 0, 0]) cube(2);"), scaled("1", "1", "1", cube2));
  EXPECT_EQ(tree_of("resize([1, 2, 8]) sphere(1);"), scaled("0.5", "1", "4", "sphere(r = 1);\n"));
  EXPECT_NE(tree_of("resize([4, 4, 4]) rotate([90, 0, 0]) scale([1, 2, 1]) sphere(1);")
                .find("[[2, 0, 0, 0], [0, 2, 0, 0], [0, 0, 1, 0]"),
            std::string::npos);
  EXPECT_NE(warnings_of("resize([4, 4, 4]) difference() { cube(2); cube(1); }").find("may be larger"),
            std::string::npos);
  EXPECT_NE(error_of("resize([4, 4, 4]) halfspace();").find("finite size"), std::string::npos);
}

TEST(Primitives, ParametersOfOpenscad) {
  EXPECT_EQ(tree_of("sphere(d = 3);"), "sphere(r = 1.5);\n");
  EXPECT_EQ(tree_of("cube([1, 2, 3], center = true);"), "cube(size = [1, 2, 3], center = true);\n");
  EXPECT_EQ(tree_of("cylinder(2, 3);"), "cylinder(h = 2, r1 = 3, r2 = 1, center = false);\n");
  EXPECT_EQ(tree_of("cylinder(h = 2, d = 4);"), "cylinder(h = 2, r = 2, center = false);\n");
  EXPECT_EQ(tree_of("cylinder(h = 2, d1 = 4, d2 = 2, center = true);"),
            "cylinder(h = 2, r1 = 2, r2 = 1, center = true);\n");
  EXPECT_EQ(tree_of("cylinder(h = 2, r = 1, r1 = 3);"), "cylinder(h = 2, r1 = 3, r2 = 1, center = false);\n");
}

TEST(Primitives, TenonsOwnTakeTheirFields) {
  EXPECT_EQ(tree_of("torus(2, 0.5);"), "torus(R = 2, r = 0.5);\n");
  EXPECT_EQ(tree_of("halfspace(d = 3, normal = [1, 0, 0]);"), "halfspace(normal = [1, 0, 0], d = 3);\n");
  EXPECT_NE(error_of("torus(radius = 2);").find("scene.scad:1:7: error: torus() has no parameter 'radius'"),
            std::string::npos);
  EXPECT_NE(error_of("torus(R = \"a\");").find("'R' must be a finite number"), std::string::npos);
}

TEST(Primitives, WithoutSizeAreAWarning) {
  for (const char* none : {"sphere(0);", "sphere(-1);", "cube(-1);", "cube([1, 0, 1]);", "cylinder(h = 0);",
                           "cylinder(r = 0, h = 1);", "cylinder(h = 1, r = 0, $fn = 6);", "torus(R = 1, r = 0);"}) {
    EXPECT_EQ(tree_of(none), "") << none;
    EXPECT_NE(warnings_of(none).find("scene.scad:1:1: warning: "), std::string::npos) << none;
  }
}

std::size_t plane_count(const std::string& text, const LoadOptions& options = {}) {
  const Outcome outcome = evaluate(text, options);
  if (!outcome.model || outcome.model->graph.primitives.size() != 1) return 0;
  const auto values = outcome.model->graph.primitives.values(PrimitiveId{0});
  const auto* planes = std::get_if<std::vector<Plane>>(&values.front());
  return planes ? planes->size() : 0;
}

TEST(Facets, SmallCountsAreMeant) {
  EXPECT_EQ(plane_count("cylinder(h = 1, r = 1, $fn = 6);"), 8u);
  EXPECT_EQ(plane_count("$fn = 4; cylinder(h = 1, r1 = 1, r2 = 0);"), 5u);
  EXPECT_EQ(plane_count("cylinder(h = 1, r1 = 0, r2 = 1, $fn = 3);"), 4u);
  EXPECT_EQ(plane_count("sphere(1, $fn = 6);"), 14u);
  EXPECT_EQ(plane_count("translate([1, 2, 3], $fn = 6) sphere(1);"), 14u);
  EXPECT_EQ(plane_count("sphere(1, $fn = 13);"), 0u);
  EXPECT_EQ(plane_count("sphere(1);"), 0u);
  EXPECT_EQ(plane_count("sphere(1, $fn = 6);", {Facets::never, {}}), 0u);
  EXPECT_EQ(plane_count("sphere(1);", {Facets::always, {}}), 12u);
}

TEST(Polyhedron, OfConvexShape) {
  const std::string points = "p = [[0,0,0],[1,0,0],[0,1,0],[0,0,1]]; ";
  EXPECT_EQ(plane_count(points + "polyhedron(p, [[0,1,2],[0,3,1],[1,3,2],[0,2,3]]);"), 4u);
  EXPECT_EQ(plane_count(points + "polyhedron(p, [[2,1,0],[0,3,1],[1,3,2],[3,2,0]]);"), 4u) << "orientation is free";
  EXPECT_EQ(plane_count(
                "polyhedron([[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0,0,1],[1,0,1],[1,1,1],[0,1,1]],"
                "[[0,1,2],[0,2,3],[4,5,6],[4,6,7],[0,1,5],[0,5,4],[1,2,6],[1,6,5],[2,3,7],[2,7,6],[3,0,4],[3,4,7]]);"),
            6u)
      << "triangles of one side share its plane";
  EXPECT_NE(error_of(points + "polyhedron(p, [[0,1,2],[0,3,1],[1,3,2]]);").find("is not closed"), std::string::npos);
  EXPECT_NE(error_of(points + "polyhedron(p, [[0,1,2],[0,3,1],[1,3,2],[0,2,7]]);").find("only 4 points"),
            std::string::npos);
  EXPECT_EQ(tree_of("polyhedron([[0,0,0],[1,0,0],[0,1,0]], [[0,1,2],[2,1,0]]);"), "");
}

// A quadrilateral that is bent is folded along its shorter diagonal.
TEST(Polyhedron, OfBentFaces) {
  const auto scene = [](const char* height) {
    return "polyhedron([[0,0,0],[2,0,0],[2,2," + std::string(height) +
           "],[0,2,0],[1,1,3]], [[0,1,2,3],[1,0,4],[2,1,4],[3,2,4],[0,3,4]]);";
  };
  EXPECT_NE(warnings_of(scene("0.5")).find("1 face that is not flat"), std::string::npos) << warnings_of(scene("0.5"));
  EXPECT_EQ(warnings_of(scene("0")), "");
  const std::string folded = tree_of(scene("0.5"));
  EXPECT_NE(folded.find("[3, 0, 1], [1, 2, 3]"), std::string::npos) << folded;
}

// A tetrahedron with a dent; clockwise as seen from outside, then the other way round, then one face turned.
TEST(Polyhedron, OfAnyShape) {
  const std::string points = "polyhedron([[0,0,0],[4,0,0],[0,4,0],[0,0,4],[0.5,0.5,0.5]],";
  const std::string mesh =
      "polyhedron(points = [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4], [0.5, 0.5, 0.5]], faces = "
      "[[0, 1, 2], [0, 3, 1], [0, 2, 3], [1, 3, 4], [3, 2, 4], [2, 1, 4]]);\n";
  EXPECT_EQ(tree_of(points + "[[0,1,2],[0,3,1],[0,2,3],[1,3,4],[3,2,4],[2,1,4]]);"), mesh);
  EXPECT_EQ(tree_of(mesh), mesh);
  EXPECT_EQ(tree_of(points + "[[0,2,1],[0,1,3],[0,3,2],[1,4,3],[3,4,2],[2,4,1]]);").substr(0, 20), mesh.substr(0, 20));
  EXPECT_NE(error_of(points + "[[0,2,1],[0,3,1],[0,2,3],[1,3,4],[3,2,4],[2,1,4]]);").find("do not all face one way"),
            std::string::npos);
  // An L of two quadrangles deep: its ends are faces of six corners that are not convex.
  const std::string ell =
      "polyhedron([for (z = [0, 1]) each [[0,0,z],[2,0,z],[2,1,z],[1,1,z],[1,2,z],[0,2,z]]],"
      "[[0,1,2,3,4,5],[11,10,9,8,7,6],each [for (i = [0:5]) [i, i + 6, (i + 1) % 6 + 6, (i + 1) % 6]]]);";
  const Outcome outcome = evaluate(ell);
  ASSERT_TRUE(outcome.model.ok()) << error_of(ell);
  const auto values = outcome.model->graph.primitives.values(PrimitiveId{0});
  EXPECT_EQ(std::get<SharedMesh>(values.front())->triangles.size(), 20u);
}

}  // namespace
}  // namespace tenon
