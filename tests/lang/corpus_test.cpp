// The corpus holds programs beside what OpenSCAD 2021.01 echoes for them. Where that program is installed, the
// expectations themselves are checked against it.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "lang/language.h"

namespace tenon {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(TENON_CORPUS)) {
    if (entry.path().extension() == ".scad") names.push_back(entry.path().stem());
  }
  std::sort(names.begin(), names.end());
  return names;
}

// OpenSCAD writes its warnings between the echoed lines.
std::string without_warnings(const std::string& text) {
  std::istringstream in(text);
  std::string out;
  for (std::string line; std::getline(in, line);) {
    const bool warning = line.starts_with("WARNING:") || line.starts_with("DEPRECATED:") || line.starts_with("\tin ");
    if (!warning) out += line + '\n';
  }
  return out;
}

class Corpus : public testing::TestWithParam<std::string> {};

TEST_P(Corpus, EchoesWhatOpenscadEchoes) {
  const fs::path path = fs::path(TENON_CORPUS) / (GetParam() + ".scad");
  Outcome outcome{Model{}, Diagnostics()};
  outcome.model = load_model(path, {}, outcome.diagnostics);
  ASSERT_TRUE(outcome.model.ok()) << format_error(outcome.model.error());
  EXPECT_EQ(outcome.said(), read(fs::path(TENON_CORPUS) / (GetParam() + ".echo")));
}

TEST_P(Corpus, ExpectationsAreOpenscads) {
  if (std::system("openscad --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "OpenSCAD is not installed";
  const fs::path out = fs::temp_directory_path() / ("tenon_corpus_" + GetParam() + ".echo");
  const std::string command =
      "cd '" TENON_CORPUS "' && openscad -o '" + out.string() + "' " + GetParam() + ".scad > /dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(without_warnings(read(out)), read(fs::path(TENON_CORPUS) / (GetParam() + ".echo")));
  fs::remove(out);
}

TEST(StandIns, OpenASceneOfTenonInOpenscad) {
  if (std::system("openscad --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "OpenSCAD is not installed";
  const fs::path scene = fs::temp_directory_path() / "tenon_stand_ins.scad";
  const fs::path out = fs::temp_directory_path() / "tenon_stand_ins.csg";
  std::ofstream(scene)
      << "include <tenon.scad>\n"
         "material(\"glass\", color = \"red\") torus(R = 2, r = 0.5);\n"
         "material(kd = 1, ks = 0) { hyperboloid(h = 2, r = 1, waist = 0.4); paraboloid(h = 2, r = 1); }\n"
         "intersection() { halfspace([1, 1, 1], 0.5); complement() sphere(1); }\n"
         "convex_polyhedron(planes = [[1, 0, 0, 1], [-1, 0, 0, 1], [0, 1, 0, 1], [0, -1, 0, 1],"
         "[0, 0, 1, 1], [0, 0, -1, 1]]);\n"
         "camera(from = [1, 2, 3], at = [0, 0, 0]); light(position = [1, 2, 3]);\n"
         "background(\"white\"); ambient(0.2);\n";
  const std::string command =
      "OPENSCADPATH='" TENON_SHARE "' openscad -o '" + out.string() + "' '" + scene.string() + "' 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  const std::string tree = read(out);
  for (const char* made : {"rotate_extrude", "color([1, 0, 0, 1])", "intersection", "difference"}) {
    EXPECT_NE(tree.find(made), std::string::npos) << made;
  }
  Diagnostics diagnostics;
  const auto model = load_model(scene, {}, diagnostics);
  ASSERT_TRUE(model.ok()) << format_error(model.error());
  EXPECT_EQ(model->graph.primitives.size(), 6u);
  fs::remove(scene);
  fs::remove(out);
}

INSTANTIATE_TEST_SUITE_P(Programs, Corpus, testing::ValuesIn(programs()),
                         [](const auto& instance) { return instance.param; });

}  // namespace
}  // namespace tenon
