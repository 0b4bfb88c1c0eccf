#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace tenon::bench {
namespace {

// bench/page.py on made-up results, one file a part.
class BenchPage : public ::testing::Test {
 protected:
  BenchPage() { std::filesystem::create_directories(folder_); }
  ~BenchPage() override { std::filesystem::remove_all(folder_); }

  // ./dev test installs it; who builds without that need not have it.
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c '' 2>/dev/null") != 0) GTEST_SKIP() << "no Python";
  }

  void write(const std::string& part, const std::string& rows) { std::ofstream(folder_ / (part + ".json")) << rows; }

  std::string page() {
    EXPECT_TRUE(runs()) << read("error.txt");
    return read("page.md");
  }

  // What the script says where it makes no page.
  std::string error() {
    EXPECT_FALSE(runs());
    EXPECT_FALSE(std::filesystem::exists(folder_ / "page.md"));
    return read("error.txt");
  }

  const std::filesystem::path folder_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("tenon_bench_") + ::testing::UnitTest::GetInstance()->current_test_info()->name());

 private:
  bool runs() const {
    const std::string folder = folder_.string();
    const std::string command = "cd " TENON_ROOT " && /usr/bin/python3 bench/page.py '" + folder + "' '" + folder +
                                "/page.md' 2>'" + folder + "/error.txt'";
    return std::system(command.c_str()) == 0;
  }

  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder_ / name).rdbuf();
    return text.str();
  }
};

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(BenchPage, HoldsRatiosTheirMeanAndTheLeast) {
  write("structures", R"([
    {"scene": "a", "rays": "primary", "contender": "cells", "mrays_per_second": 8},
    {"scene": "a", "rays": "primary", "contender": "cells, ray by ray", "mrays_per_second": 7},
    {"scene": "a", "rays": "primary", "contender": "slow", "mrays_per_second": 1},
    {"scene": "a", "rays": "primary", "contender": "less slow", "mrays_per_second": 4},
    {"scene": "b", "rays": "primary", "contender": "cells", "mrays_per_second": 9},
    {"scene": "b", "rays": "primary", "contender": "slow", "mrays_per_second": 0.5}])");
  const std::string text = page();
  EXPECT_TRUE(has(text, "| a | 2 |")) << text;
  EXPECT_TRUE(has(text, "| b | 18 |")) << text;
  EXPECT_TRUE(has(text, "| **geometric mean** | **6** |")) << text;
  EXPECT_TRUE(has(text, "| least | 2 |")) << text;
  EXPECT_TRUE(has(text, "| a | primary | 8 | 4 | less slow |")) << text;
  EXPECT_FALSE(has(text, "POV-Ray")) << "a part that was not measured";
}

TEST_F(BenchPage, SetsBatchesAgainstPacketsAndSingleRaysAgainstSingleRays) {
  write("embree", R"([
    {"scene": "a", "figure": "mesh 1920: triangles", "value": 12345, "unit": ""},
    {"scene": "a", "rays": "shadow", "contender": "tenon cells", "mrays_per_second": 30},
    {"scene": "a", "rays": "shadow", "contender": "tenon cells, ray by ray", "mrays_per_second": 5},
    {"scene": "a", "rays": "shadow", "contender": "embree 1 mesh 1920", "mrays_per_second": 10},
    {"scene": "a", "rays": "shadow", "contender": "embree 8 mesh 1920", "mrays_per_second": 25},
    {"scene": "a", "rays": "shadow", "contender": "embree 16 mesh 1920", "mrays_per_second": 60}])");
  const std::string text = page();
  const auto packets = text.find("| a | 0.5 |"), batches = text.find("| a | 3 |"),
             singly = text.find("| a | 0.5 |", batches);
  EXPECT_LT(packets, batches) << text;
  EXPECT_NE(singly, std::string::npos) << text;
  EXPECT_TRUE(has(text, "| a | shadow | 12,345 | 30 | 5 | 10 | 25 | 60 |")) << text;
}

TEST_F(BenchPage, SetsAllCoresAgainstOne) {
  write("cores", R"([
    {"scene": "a", "rays": "primary", "contender": "cells", "mrays_per_second": 10},
    {"scene": "a", "rays": "primary x2", "contender": "cells", "mrays_per_second": 19},
    {"scene": "a", "rays": "shadow", "contender": "cells", "mrays_per_second": 20},
    {"scene": "a", "rays": "shadow x2", "contender": "cells", "mrays_per_second": 39}])");
  const std::string text = page();
  EXPECT_TRUE(has(text, "| primary, 2 cores | shadow, 2 cores |")) << text;
  EXPECT_TRUE(has(text, "| a | 1.9 | 1.95 |")) << text;
}

// What the options of the bench leave out (--against cells, --accel, --largest) is named, with the way to get it.
TEST_F(BenchPage, SaysWhichPartLacksWhatAPageNeeds) {
  const std::string path = (folder_ / "structures.json").string();
  write("structures", R"([
    {"scene": "a", "rays": "primary", "contender": "cells", "mrays_per_second": 8},
    {"scene": "a", "rays": "primary", "contender": "cells, ray by ray", "mrays_per_second": 7}])");
  std::string text = error();
  EXPECT_TRUE(has(text, path + " holds no other structure to compare 'cells' with")) << text;
  EXPECT_TRUE(has(text, "./dev bench structures")) << text;
  EXPECT_FALSE(has(text, "Traceback")) << text;

  write("structures", "[]");
  write("povray", R"([
    {"scene": "a", "rays": "picture", "contender": "tenon kd-tree", "mrays_per_second": 8},
    {"scene": "a", "rays": "picture", "contender": "povray", "mrays_per_second": 7}])");
  text = error();
  EXPECT_TRUE(has(text, "povray.json holds no rates of 'tenon cells' beside those of 'tenon kd-tree'")) << text;

  write("povray", "[]");
  write("growth", R"([
    {"scene": "100 spheres", "figure": "building cells", "value": 1, "unit": "s"},
    {"scene": "100 spheres", "figure": "memory of it", "value": 1, "unit": "MiB"},
    {"scene": "100 spheres", "rays": "primary", "contender": "cells", "mrays_per_second": 8}])");
  text = error();
  EXPECT_TRUE(has(text, "growth.json holds no scene of 1000 spheres or more")) << text;
}

}  // namespace
}  // namespace tenon::bench
