// import() of drawings, and what else the language asks of them.
#include "lang/files_folder.h"

namespace tenon {
namespace {

/// A drawing: a square of 4 on layer `box`, a dimension of 4 on it, two lines that cross on layer `cross`, and a circle
/// of radius 1 around [9, 0] on layer `disc`.
class Drawings : public FilesTest {
 protected:
  void SetUp() override {
    FilesTest::SetUp();
    write("a.dxf",
          "0\nSECTION\n2\nENTITIES\n"
          "0\nLWPOLYLINE\n8\nbox\n70\n1\n10\n0\n20\n0\n10\n4\n20\n0\n10\n4\n20\n4\n10\n0\n20\n4\n"
          "0\nCIRCLE\n8\ndisc\n10\n9\n20\n0\n40\n1\n"
          "0\nDIMENSION\n8\nbox\n1\nside\n70\n0\n50\n0\n13\n0\n23\n0\n14\n4\n24\n0\n"
          "0\nLINE\n8\ncross\n10\n-1\n20\n2\n11\n1\n21\n2\n0\nLINE\n8\ncross\n10\n0\n20\n0\n11\n0\n21\n3\n"
          "0\nENDSEC\n0\nEOF\n");
    file = "\"" + (folder / "a.dxf").string() + "\"";
  }

  std::string file;
};

const std::string disc = "[[[9, -1, 1], [9, 1, 1]]]";

TEST_F(Drawings, AreShapesOfThePlane) {
  const std::string tree = tree_of("linear_extrude(2) import(" + file + ", layer = \"disc\");");
  EXPECT_NE(tree.find("prism(outline = " + disc), std::string::npos) << tree;
  const std::string moved =
      tree_of("linear_extrude(2) import(" + file + ", layer = \"disc\", origin = [8, 0], scale = 2);");
  EXPECT_NE(moved.find("prism(outline = [[[2, -2, 1], [2, 2, 1]]]"), std::string::npos) << moved;
  EXPECT_EQ(tree_of("rotate_extrude() import(" + file + ", layer = \"disc\");"), "torus(R = 9, r = 1);\n");
  EXPECT_NE(warnings_of("linear_extrude(2) import(" + file + ", layer = \"none\"); cube();")
                .find("the drawing has nothing on a layer 'none'; there is 'box', 'disc', 'cross'"),
            std::string::npos);
}

TEST_F(Drawings, MayBeExtrudedByName) {
  EXPECT_EQ(tree_of("linear_extrude(height = 2, file = " + file + ", layer = \"disc\");"),
            tree_of("linear_extrude(2) import(" + file + ", layer = \"disc\");"));
  EXPECT_EQ(tree_of("rotate_extrude(file = " + file + ", layer = \"disc\", origin = [2, 0]);"),
            tree_of("rotate_extrude() import(" + file + ", layer = \"disc\", origin = [2, 0]);"));
}

TEST_F(Drawings, MayBeSvg) {
  write("a.svg",
        "<svg width=\"10\" height=\"72\"><rect x=\"1\" y=\"2\" width=\"4\" height=\"5\"/><text>a</text></svg>");
  const std::string picture = "\"" + (folder / "a.svg").string() + "\"";
  // The page is an inch high.
  EXPECT_NE(tree_of("linear_extrude(2) import(" + picture + ");").find("[5, 23.4]"), std::string::npos)
      << tree_of("linear_extrude(2) import(" + picture + ");");
  EXPECT_NE(tree_of("linear_extrude(2) import(" + picture + ", center = true);").find("[2, 2.5]"), std::string::npos)
      << tree_of("linear_extrude(2) import(" + picture + ", center = true);");
  EXPECT_NE(warnings_of("linear_extrude(2) import(" + picture + ");").find("text is left out"), std::string::npos);
}

TEST_F(Drawings, AreMeasured) {
  EXPECT_EQ(evaluate("echo(dxf_dim(file = " + file + ", name = \"side\", scale = 2));").said(), "ECHO: 8\n");
  EXPECT_EQ(evaluate("echo(dxf_cross(file = " + file + ", layer = \"cross\", origin = [1, 1]));").said(),
            "ECHO: [-1, 1]\n");
  EXPECT_NE(warnings_of("x = dxf_dim(file = " + file + ", name = \"height\"); echo(x);")
                .find("dxf_dim() finds nothing to measure: there is no dimension 'height' in the drawing"),
            std::string::npos);
  EXPECT_NE(warnings_of("echo(dxf_cross(" + file + "));").find("by these names"), std::string::npos);
}

}  // namespace
}  // namespace tenon
