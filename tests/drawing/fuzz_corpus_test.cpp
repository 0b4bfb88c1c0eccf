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
    SCOPED_TRACE(entry.path().string());
    fuzz::try_drawing({"corpus.dxf", bytes});
    fuzz::try_svg({"corpus.svg", bytes});
    ++files;
  }
  EXPECT_GE(files, 10);
}

}  // namespace
}  // namespace tenon
