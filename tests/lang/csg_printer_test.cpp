#include <filesystem>

#include "lang/language.h"

namespace tenon {
namespace {

TEST(PrintCsg, ReadsBackToTheSameText) {
  const std::string text = tree_of(
      "camera(from = [1, 2, 3.3], at = [0, 0, 1 / 3], orthographic = 7); light(type = \"directional\", direction = [1, "
      "0, -1]);"
      "section([1, 0, 1 / 3], 0.1); section(planes = [[0, 1, 0], [0, 0, -1, 4]]);"
      "background([0.1, 0.2, 0.3, 0.5]); ambient(\"grey\");"
      "material(\"odd \\\"name\\\" \\\\\", kd = 1 / 3, ks = 2 / 3, ka = 0.7, color = [0.1, 0.2, 0.3, 0.4]) "
      "difference() {"
      "  rotate([10, 20, 30]) cube([1, 2, 3] / 7, center = true); color(\"tomato\") sphere(r = sqrt(2));"
      "  cylinder(h = 1e-9, r = 1e300); cylinder(h = 1, r1 = 2, r2 = 0); torus(); hyperboloid(h = 3, r = 2, waist = 1);"
      "  prism([[[0, 0], [1 / 3, 0, 1 / 7], [0, 1]], [[2, 0, 1], [3, 0, 1]]], h = 2, scale = 0.5);"
      "  revolution([[[1, 0], [2, 0, 0.1], [1, 1]]]);"
      "  paraboloid(); intersection() { halfspace([1, 2, 3], 0.1); complement() sphere(9, $fn = 5); }"
      "  cut_faces(\"base\") cube(7); cut_faces(\"tool\") cube(8);"
      "}");
  EXPECT_EQ(text.find("error"), std::string::npos) << text;
  EXPECT_EQ(tree_of(text), text);
}

TEST(PrintCsg, ALensReadsBackToTheSameText) {
  const std::string text = tree_of("camera(from = [1, 2, 3], fstop = 2.8, focus = [0, 0, 0.1]); cube();");
  EXPECT_NE(text.find("aperture = "), std::string::npos) << text;
  EXPECT_EQ(tree_of(text), text);
}

TEST(PrintCsg, TheScenesOfTheProject) {
  for (const auto& entry : std::filesystem::directory_iterator(TENON_SCENES)) {
    if (entry.path().extension() != ".scad") continue;
    Diagnostics diagnostics;
    const auto model = load_model(entry.path(), {}, diagnostics);
    ASSERT_TRUE(model.ok()) << format_error(model.error());
    EXPECT_TRUE(diagnostics.warnings().empty()) << entry.path() << '\n' << diagnostics.warnings().front();
    if (entry.path().stem().string().starts_with("large")) continue;
    const std::string text = print_csg(*model);
    EXPECT_EQ(tree_of(text), text) << entry.path();
  }
}

// As OpenSCAD 2021.01 exports it.
TEST(OpenscadCsg, IsRead) {
  EXPECT_EQ(tree_of("group() {\n"
                    "\tmultmatrix([[1, 0, 0, 1], [0, 1, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]]) {\n"
                    "\t\tsphere($fn = 0, $fa = 12, $fs = 2, r = 1);\n"
                    "\t}\n"
                    "\tgroup();\n"
                    "%\tcube(size = [1, 1, 1], center = false);\n"
                    "\trender(convexity = 1) {\n"
                    "\t\tcylinder($fn = 0, $fa = 12, $fs = 2, h = 2, r1 = 1, r2 = 1, center = true);\n"
                    "\t}\n"
                    "\tcolor([-1, -1, -1, 1]) {\n"
                    "\t\tpolyhedron(points = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], faces = [[0, 1, 2], [0, 3, "
                    "1], [1, 3, 2], [0, 2, 3]], convexity = 1);\n"
                    "\t}\n"
                    "}\n")
                .find("error"),
            std::string::npos);
}

}  // namespace
}  // namespace tenon
