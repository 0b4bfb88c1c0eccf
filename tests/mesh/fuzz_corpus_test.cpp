#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/try_heights.h"
#include "fuzz/try_mesh.h"

// What the fuzzers start from, and what they have found.
namespace tenon {
namespace {

TEST(FuzzCorpus, EveryReaderBearsEveryFile) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(TENON_FUZZ_CORPUS)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    for (const char* ending : {".stl", ".obj", ".off", ".ply", ".3mf", ".amf"}) {
      SCOPED_TRACE(entry.path().string() + " as " + ending);
      fuzz::try_mesh({"corpus" + std::string(ending), bytes});
    }
    for (const char* ending : {".dat", ".png"}) {
      SCOPED_TRACE(entry.path().string() + " as heights of " + ending);
      fuzz::try_heights({"corpus" + std::string(ending), bytes});
    }
    ++files;
  }
  EXPECT_GE(files, 8);
}

}  // namespace
}  // namespace tenon
