#include <filesystem>
#include <fstream>

#include "lang/language.h"

namespace tenon {
namespace {

TEST(Messages, ShowPlaceLineAndCaret) {
  EXPECT_EQ(error_of("cube(1);\n  cubee(2);\n"),
            "scene.scad:2:3: error: there is no module 'cubee' (did you mean 'cube'?)\n"
            "      cubee(2);\n"
            "      ^");
}

TEST(Messages, OfTheParser) {
  const std::pair<const char*, const char*> cases[] = {
      {"cube(1", "1:5: error: this '(' is never closed"},
      {"difference() { cube();", "1:14: error: this '{' is never closed"},
      {"x = [1, 2;", "1:10: error: expected ']' to close '['"},
      {"x = 1 +;", "1:8: error: expected a value, but found ';'"},
      {"cube() }", "1:8: error: expected ';', '{' or a child, but found '}'"},
      {"echo(\"abc);", "1:6: error: this string never ends"},
      {"/* abc", "1:1: error: this comment never ends"},
      {"x = 3\ny = 4;", "2:1: error: expected ';' after the assignment, but found 'y'"},
      {"module (){}", "1:8: error: expected a name after 'module'"},
      {"cube(`);", "1:6: error: the character '`'"},
      {"union() { use <a.scad> }", "'use' stands at the top of a file"},
      {"include <no such file>", "1:1: error: there is no file 'no such file'"},
  };
  for (const auto& [text, expected] : cases)
    EXPECT_NE(error_of(text).find(expected), std::string::npos) << error_of(text);
}

TEST(Messages, OfAssertions) {
  EXPECT_NE(error_of("assert(1 == 2, \"msg\");").find("1:1: error: assertion '(1 == 2)' failed: \"msg\""),
            std::string::npos);
  EXPECT_NE(error_of("x = assert(false) 3;").find("1:5: error: assertion 'false' failed"), std::string::npos);
}

TEST(Messages, WhatIsNotBuiltYetIsAnError) {
  for (const char* name : {"fill", "roof"}) {
    const std::string expected = "scene.scad:1:1: error: " + std::string(name) + "() is not supported yet";
    EXPECT_NE(error_of(std::string(name) + "() cube();").find(expected), std::string::npos);
  }
}

TEST(Messages, WarningsHaveAPlaceAndComeOnce) {
  EXPECT_EQ(warnings_of("for (i = [1:100]) { x = nothing; }"),
            "scene.scad:1:25: warning: the variable 'nothing' is not defined here; its value is undef\n"
            "    for (i = [1:100]) { x = nothing; }\n"
            "                            ^\n");
  EXPECT_NE(warnings_of("echo($nothing);").find("'$nothing' is not defined"), std::string::npos);
  EXPECT_NE(warnings_of("echo(sine(3));").find("there is no function 'sine' (did you mean 'sin'?)"), std::string::npos);
  EXPECT_NE(warnings_of("sphere(radius = 3);").find("sphere() has no parameter 'radius'"), std::string::npos);
  EXPECT_NE(warnings_of("a = 1;\na = 2;").find("2:1: warning: 'a' was assigned in line 1 already"), std::string::npos);
  EXPECT_NE(warnings_of("cube(1)\nsphere(2);").find("2:1: warning: cube() has no children"), std::string::npos);
  EXPECT_NE(warnings_of("x = [3:1];").find("write [3:-1:1]"), std::string::npos);
}

TEST(Files, ThatCannotBeRead) {
  Diagnostics diagnostics;
  const auto message = [&](const std::string& path) {
    const auto model = load_model(path, {}, diagnostics);
    return model ? "no error" : format_error(model.error());
  };
  EXPECT_NE(message("/no/such/file.scad").find("there is no file '/no/such/file.scad'"), std::string::npos);
  EXPECT_NE(message("/tmp").find("is a directory"), std::string::npos);
  EXPECT_NE(message("/proc/self/exe").find("is not a text file"), std::string::npos);
}

TEST(Files, IncludeThemselves) {
  const auto path = std::filesystem::temp_directory_path() / "tenon_includes_itself.scad";
  std::ofstream(path) << "include <tenon_includes_itself.scad>\ncube();\n";
  Diagnostics diagnostics;
  const auto model = load_model(path, {}, diagnostics);
  ASSERT_FALSE(model.ok());
  EXPECT_NE(model.error().message.find("include each other"), std::string::npos);
  std::filesystem::remove(path);
}

TEST(Definitions, OverrideTheFilesOwn) {
  EXPECT_EQ(tree_of("r = 1; s = r; sphere(s);", {Facets::automatic, {{"r", "2 + 1"}}}), "sphere(r = 3);\n");
  const Outcome outcome = evaluate("r = 1;", {Facets::automatic, {{"r", "2"}}});
  EXPECT_EQ(outcome.warnings(), "");
  EXPECT_NE(tree_of("", {Facets::automatic, {{"r", "("}}}).find("-D:1:"), std::string::npos);
}

TEST(Messages, SlipsOfThoseWhoThinkInAnotherLanguage) {
  EXPECT_NE(error_of("if (x = 3) cube();").find("to compare, write '=='"), std::string::npos);
  EXPECT_NE(error_of("for (i = 0:3) cube();").find("a range is written [first : last]"), std::string::npos);
}

TEST(Messages, ATransformWithoutChildrenIsSuspicious) {
  EXPECT_NE(warnings_of("rotate(90); cube();").find("scene.scad:1:1: warning: rotate() has no children"),
            std::string::npos);
  EXPECT_EQ(warnings_of("rotate(90) cube(); multmatrix([[1,0,0,1],[0,1,0,0],[0,0,1,0]]);"), "");
}

TEST(Messages, AnUnknownParameterNamesThoseThereAre) {
  EXPECT_NE(warnings_of("cylinder(h = 3, radius = 4);").find("no parameter 'radius'; there is h, "), std::string::npos);
}

}  // namespace
}  // namespace tenon
