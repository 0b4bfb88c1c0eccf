#include "lang/language.h"

namespace tenon {
namespace {

TEST(Text, IsAShapeOfThePlane) {
  const std::string tree = tree_of("linear_extrude(2) text(\"II\");");
  // Both letters, beside one another.
  EXPECT_NE(tree.find("union() {\n\t\tmultmatrix([[1, 0, 0, 0]"), std::string::npos) << tree;
  EXPECT_EQ(tree.find("prism("), tree.find("prism(outline = [[["));
  EXPECT_EQ(tree_of("linear_extrude(2) text(\"\"); cube();"), tree_of("cube();"));
  EXPECT_EQ(tree_of("linear_extrude(2) text(\" \"); cube();"), tree_of("cube();"));
  EXPECT_EQ(tree_of("linear_extrude(1) text(str(1.5));"), tree_of("linear_extrude(1) text(\"1.5\");"));
  // Arcs, unless facets are asked for.
  EXPECT_NE(tree_of("linear_extrude(1) text(\"O\");"), tree_of("linear_extrude(1) text(\"O\", $fn = 8);"));
}

TEST(Text, SaysWhatItDoesNotKnow) {
  EXPECT_NE(warnings_of("linear_extrude(1) text(\"A\", font = \"No Such Family\");").find("stands in for it"),
            std::string::npos);
  EXPECT_NE(warnings_of("linear_extrude(1) text(\"A\", halign = \"middle\");")
                .find("'halign' is one of \"left\", \"center\", \"right\"; it is \"left\""),
            std::string::npos);
  EXPECT_NE(warnings_of("linear_extrude(1) text(7); cube();").find("'text' must be a text in quotes, not 7"),
            std::string::npos);
  EXPECT_NE(error_of("text(\"A\", size = 1 / 0);").find("must be finite"), std::string::npos);
}

}  // namespace
}  // namespace tenon
