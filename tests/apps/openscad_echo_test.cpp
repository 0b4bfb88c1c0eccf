#include <algorithm>
#include <map>

#include "apps/program_test.h"

// What OpenSCAD's own regression tests say that its programs echo, held against what Tenon echoes for them: Debian's
// `openscad-testing-data`. Skipped where the package is absent.
namespace tenon {
namespace {

namespace fs = std::filesystem;

const fs::path data = "/usr/share/openscad";

// Where Tenon differs, and why; everything else is the same, line by line.
const std::map<std::string, std::string> different{
    {"builtin-invalid-range-test", "a polyhedron of points that are no numbers is an error"},
    {"empty-stl", "a file that is no mesh is an error"},
    {"errors-warnings", "a drawing that is not there is an error"},
    {"errors-warnings-included", "the same"},
    {"for-tests", "endless ranges are an error"},
    {"function-literal-tests", "a closure sees the special variables of its call"},
    {"include-recursive-test", "files that include themselves are an error"},
    {"include-tests", "a file that is not there is an error"},
    {"nbsp-latin1-test", "scenes are UTF-8"},
    {"ord-tests", "ord() of bytes that are no UTF-8"},
    {"preview_variable", "$preview: pictures are taken of what would be exported"},
    {"rands", "ranges, counts and seeds that are not finite"},
    {"trig-tests", "atan2() of a negative zero is 180 degrees, not -180"},
    {"variable-scope-tests", "arguments that are no parameters are ignored, with a warning"},
};

std::vector<std::string> echoes(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) {
    if (line.starts_with("ECHO")) lines.push_back(line);
  }
  return lines;
}

std::string text_of(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

class OpenScadEchoes : public ProgramTest {};

TEST_F(OpenScadEchoes, AreThoseOfItsOwnTests) {
  if (!fs::exists(data / "regression/echotest")) GTEST_SKIP() << "install openscad-testing-data to run this";
  std::map<std::string, fs::path> programs;
  for (const auto& entry : fs::recursive_directory_iterator(data / "testdata/scad")) {
    if (entry.path().extension() == ".scad") programs.emplace(entry.path().stem(), entry.path());
  }
  int same = 0;
  for (const auto& entry : fs::directory_iterator(data / "regression/echotest")) {
    const std::string file = entry.path().filename();
    const std::string name = file.substr(0, file.find("-expected.echo"));
    const auto program = programs.find(name);
    if (program == programs.end()) continue;
    const Outcome outcome = run({"render", program->second.string(), "-o", "x.png", "--size", "4x4", "--quiet"});
    const auto found = echoes(outcome.out + outcome.err), expected = echoes(text_of(entry.path()));
    if (different.contains(name)) {
      EXPECT_NE(found, expected) << name << " is as OpenSCAD has it: take it off the list";
    } else {
      EXPECT_EQ(found, expected) << name;
      ++same;
    }
  }
  EXPECT_GE(same, 80);
}

}  // namespace
}  // namespace tenon
