#include "lang/files_folder.h"

namespace tenon {
namespace {

TEST_F(FilesTest, WhatAFileMakesIsStoredOnceAndPrintedByItsName) {
  write("map.dat", "1 2\n3 4\n");
  const std::string map = (folder / "map.dat").string();
  const std::string surface = "surface(file = \"" + map + "\");\n";
  EXPECT_EQ(tree_of("surface(\"" + map + "\"); translate([5, 0, 0]) surface(file = \"" + map + "\", convexity = 3);"),
            "union() {\n\t" + surface +
                "\tmultmatrix([[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]) {\n\t\t" + surface +
                "\t}\n}\n");
  const Outcome twice =
      evaluate("surface(\"" + map + "\"); surface(\"" + map + "\"); surface(\"" + map + "\", center = true);");
  ASSERT_TRUE(twice.model);
  EXPECT_EQ(twice.model->graph.primitives.size(), 2u);
}

TEST_F(FilesTest, AMeshFileIsTheSceneOfThatMesh) {
  write("a \"b\".off", "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  Diagnostics diagnostics;
  const Result<Model> model = load_model((folder / "a \"b\".off").string(), {}, diagnostics);
  ASSERT_TRUE(model) << format_error(model.error());
  EXPECT_EQ(print_csg(*model).find("import(file = "), 0u) << print_csg(*model);
  const Result<Model> none = load_model((folder / "none.off").string(), {}, diagnostics);
  ASSERT_FALSE(none);
  EXPECT_NE(format_error(none.error()).find("there is no file"), std::string::npos) << format_error(none.error());
  write("bad.off", "OFF 1 1 0\n0 0 0\n3 0 1 2\n");
  EXPECT_FALSE(load_model((folder / "bad.off").string(), {}, diagnostics));
}

TEST_F(FilesTest, TheStructureWithinAMeshIsChosenByName) {
  write("t.off", "OFF 4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n");
  const std::string mesh = (folder / "t.off").string();
  EXPECT_EQ(tree_of("import(\"" + mesh + "\", local = \"kd\");"), "import(file = \"" + mesh + "\", local = \"kd\");\n");
  EXPECT_EQ(tree_of("import(\"" + mesh + "\", local = \"bvh\");"), "import(file = \"" + mesh + "\");\n");
  EXPECT_NE(error_of("import(\"" + mesh + "\", local = \"grid\");").find("'local' must be \"bvh\" or \"kd\""),
            std::string::npos);
}

TEST_F(FilesTest, WhatIsWrongInAFileIsSaidWithItsPlaceInTheFile) {
  write("map.dat", "1 2\n3 x\n");
  EXPECT_NE(error_of("surface(\"" + (folder / "map.dat").string() + "\");").find("map.dat:2:3: error: 'x'"),
            std::string::npos);
  EXPECT_NE(error_of("surface();").find("surface() needs 'file', the name of a height map in quotes"),
            std::string::npos);
  EXPECT_NE(error_of("surface(\"nowhere.dat\");").find("nowhere.dat"), std::string::npos);
}

}  // namespace
}  // namespace tenon
