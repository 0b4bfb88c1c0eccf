#include "lang/files_folder.h"

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

class FontFileTest : public FilesTest {};

TEST_F(FontFileTest, IsUsedLikeALibrary) {
  const std::string file = "/usr/share/fonts/truetype/liberation/LiberationMono-Bold.ttf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "install Debian's fonts-liberation to run this";
  std::filesystem::copy_file(file, folder / "own.TTF");
  const std::string letter = "linear_extrude(1) text(\"A\", font = \"Liberation Mono:style=Bold\");";
  const std::string use = "use <" + (folder / "own.TTF").string() + ">\n";
  EXPECT_EQ(tree_of(use + letter), tree_of(letter));
  EXPECT_EQ(warnings_of(use + use + letter), "");
  write("none.ttf", "no font");
  EXPECT_NE(error_of("use <" + (folder / "none.ttf").string() + ">\ncube();").find("none.ttf' is no font"),
            std::string::npos);
}

// Its letters have codes of their own, and no Unicode.
TEST_F(FontFileTest, MayBeOneOfSymbols) {
  const std::string file = "/usr/share/openscad/testdata/ttf/marvosym-3.10/marvosym.ttf";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << "install Debian's openscad-testing-data to run this";
  const std::string tree = tree_of("use <" + file + ">\nlinear_extrude(1) text(\"a1\", font = \"MarVoSym\");");
  EXPECT_NE(tree.find("prism(outline = [[["), tree.rfind("prism(outline = [[[")) << tree;
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
