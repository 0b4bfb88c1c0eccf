#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "fuzz/try_drawing.h"

// What the fuzzers start from, and what they have found.
namespace tenon {
namespace {

TEST(FuzzCorpus, EveryDrawingReaderBearsEveryFile) {
  int files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(TENON_FUZZ_CORPUS)) {
    if (!entry.is_regular_file()) continue;
    std::ifstream stream(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    for (const char* ending : {".dxf"}) {
      SCOPED_TRACE(entry.path().string() + " as " + ending);
      fuzz::try_drawing({"corpus" + std::string(ending), bytes});
    }
    ++files;
  }
  EXPECT_GE(files, 9);
}

}  // namespace
}  // namespace tenon
