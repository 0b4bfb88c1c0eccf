// No scene overflows a stack, fills the memory or runs for ever on a single loop.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string_view>

#include "lang/language.h"

namespace tenon {
namespace {

std::size_t count_of(std::string_view word, std::string_view text) {
  std::size_t count = 0;
  for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) ++count;
  return count;
}

TEST(Depth, ALopsidedRecursionOf100000Segments) {
  const Outcome outcome = evaluate(
      "module segment() sphere(1);"
      "module shell(n) { segment(); if (n > 1) rotate([1, 2, 3]) scale(0.9999) shell(n - 1); }"
      "shell(100000);");
  ASSERT_TRUE(outcome.model.ok()) << format_error(outcome.model.error());
  EXPECT_EQ(outcome.model->graph.primitives.size(), 1u) << "what is the same is there once";

  const std::string text = print_csg(*outcome.model);
  EXPECT_EQ(count_of("sphere(", text), 100000u);
  const Outcome again = evaluate(text);
  ASSERT_TRUE(again.model.ok()) << format_error(again.model.error());
  EXPECT_EQ(print_csg(*again.model), text);
}

TEST(Depth, MoreModulesALevel) {
  const Outcome outcome = evaluate(
      "module shell(n) { if (n == 0) sphere(1); else translate([0, 0, 1]) color(\"red\") let (m = n - 1)"
      "for (i = [0]) difference() { shell(m); cube(2); } } shell(100000);");
  ASSERT_TRUE(outcome.model.ok()) << format_error(outcome.model.error());
  EXPECT_EQ(count_of("cube(", print_csg(*outcome.model)), 100000u);
}

TEST(Depth, FunctionsAndLists) {
  const Outcome outcome = evaluate(
      "function count(n) = n == 0 ? 0 : 1 + count(n - 1); echo(count(100000));"
      "function sum(n, a = 0) = n == 0 ? a : let (m = n - 1) assert(true) sum(m, a + n); echo(sum(999999));"
      "function nest(n, a = []) = n == 0 ? a : nest(n - 1, [a]);"
      "echo(nest(900000) == nest(900000), len(nest(900000)));");
  ASSERT_TRUE(outcome.model.ok()) << format_error(outcome.model.error());
  EXPECT_EQ(outcome.said(), "ECHO: 100000\nECHO: 5e+11\nECHO: true, 1\n");
}

void expect_message(const std::string& text, const std::string& expected) {
  const std::string message = error_of(text);
  EXPECT_NE(message.find(expected), std::string::npos) << message;
  EXPECT_EQ(message.find("scene.scad:1:"), 0u) << message;
}

TEST(Limits, OfNestedCalls) {
#if defined(__SANITIZE_ADDRESS__)
  GTEST_SKIP() << "AddressSanitizer cannot follow an exception through more than 64 MiB of stack";
#endif
  for (const char* endless : {"module m() m(); m();", "module m() { translate([1, 2, 3]) m(); } m();",
                              "function f(x) = 1 + f(x + 1); echo(f(0));", "f = function(n) [f(n)]; echo(f(0));"}) {
    expect_message(endless, "calls are nested more than 200,000 deep");
  }
}

TEST(Limits, OfLoopsAndLists) {
  const std::pair<const char*, const char*> cases[] = {
      {"function f(x) = f(x + 1); echo(f(0));", "called itself 1,000,000 times"},
      {"for (i = [0:1e12]) cube(i);", "a range of 1e+12 numbers is too long"},
      {"for (i = [0:1/0]) cube(i);", "a range of endlessly many numbers is too long"},
      {"x = [for (i = 0; true; i = i + 1) i];", "10,000,000 turns"},
      {"function d(n, a = [1]) = n == 0 ? a : d(n - 1, concat(a, a)); x = d(40);", "more than 512 MiB"},
      {"function d(n, a = \"x\") = n == 0 ? a : d(n - 1, str(a, a)); x = d(40);", "512 MiB"},
      {"function d(n, a = \"x\") = n == 0 ? a : d(n - 1, [a, a]); x = str(d(40));", "512 MiB"},
      {"x = rands(0, 1, 1e12);", "more than 512 MiB"},
      {"function d(n, a = []) = n == 0 ? a : d(n - 1, [a]); x = d(999999, d(999999));",
       "nested more than 1,000,000 deep"},
  };
  for (const auto& [text, expected] : cases) expect_message(text, expected);
}

TEST(Limits, EmptyTextIsAnEmptyModel) {
  const Outcome outcome = evaluate("");
  ASSERT_TRUE(outcome.model.ok());
  EXPECT_FALSE(outcome.model->graph.root);
}

// Damages a program as a slip of the hand or of a disk would.
std::string damaged(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random()) % n; };
  const std::string scraps[] = {"(",  ")",   "[",  "]",    "{",    "}",   ";",    "=",      "undef",
                                "-1", "1e9", "\"", "for(", "let(", "$fn", "\xff", "[0:1e8]"};
  for (std::size_t edits = 1 + below(4); edits > 0 && !text.empty(); --edits) {
    const std::size_t at = below(text.size());
    switch (below(4)) {
      case 0:
        text.erase(at, 1 + below(8));
        break;
      case 1:
        text.insert(at, scraps[below(std::size(scraps))]);
        break;
      case 2:
        text[at] = static_cast<char>(1 + below(255));
        break;
      default:
        text.insert(at, text.substr(below(text.size()), below(40)));
        break;
    }
  }
  return text;
}

TEST(Fuzz, DamagedProgramsAreEvaluatedOrRefusedWithAPlace) {
  std::vector<std::string> programs;
  for (const char* folder : {TENON_CORPUS, TENON_SCENES}) {
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".scad" || entry.path().stem().string().starts_with("large")) continue;
      std::ostringstream text;
      text << std::ifstream(entry.path()).rdbuf();
      programs.push_back(text.str());
    }
  }
  std::sort(programs.begin(), programs.end());
  std::mt19937 random(1);
  for (int i = 0; i < 400; ++i) {
    // Whole programs seldom survive an edit; a few of their lines do more often.
    std::string text = programs[random() % programs.size()];
    const std::size_t begin = text.find('\n', random() % text.size());
    if (begin != std::string::npos) text = text.substr(begin, 300);
    text = damaged(text, random);
    const Outcome outcome = evaluate(text);
    if (outcome.model) {
      const std::string printed = print_csg(*outcome.model);
      EXPECT_EQ(tree_of(printed), printed) << text;
    } else {
      EXPECT_GT(outcome.model.error().where.line, 0) << text << '\n' << outcome.model.error().message;
    }
  }
}

}  // namespace
}  // namespace tenon
