#include <algorithm>
#include <map>

#include "apps/program_test.h"

// The examples that Debian's `openscad` package installs, as they are. Each either renders or says which feature it
// waits for; none leaves a hole in silence. Skipped where the package is absent.
namespace tenon {
namespace {

const std::filesystem::path examples = "/usr/share/openscad/examples";

// What each example waits for; an example that is not listed renders.
const std::map<std::string, std::string> waiting{
    {"echo", "the scene holds no solid"},  // it only prints
};

class OpenScadExamples : public ProgramTest {};

TEST_F(OpenScadExamples, EachRendersOrNamesWhatItWaitsFor) {
  if (!std::filesystem::exists(examples)) GTEST_SKIP() << "install Debian's openscad package to run this";
  int rendered = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(examples)) {
    if (entry.path().extension() != ".scad") continue;
    const std::string name = entry.path().stem().string();
    // It uses a library that another package holds.
    if (name == "example023" && !std::filesystem::exists("/usr/share/openscad/libraries/MCAD")) continue;
    const Outcome outcome = run({"render", entry.path().string(), "-o", name + ".png", "--size", "64x48", "--quiet"});
    const bool picture = std::filesystem::exists(folder / (name + ".png"));
    if (const auto reason = waiting.find(name); reason != waiting.end()) {
      EXPECT_EQ(outcome.status, 1) << name;
      EXPECT_TRUE(contains(outcome.err, reason->second)) << name << ": " << outcome.err;
      EXPECT_FALSE(picture) << name;
    } else {
      EXPECT_EQ(outcome.status, 0) << name << ": " << outcome.err;
      EXPECT_TRUE(picture) << name;
      ++rendered;
    }
  }
  EXPECT_GE(rendered, 46);
}

}  // namespace
}  // namespace tenon
