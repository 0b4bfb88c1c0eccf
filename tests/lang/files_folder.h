#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "lang/language.h"

namespace tenon {

/// A folder of its own for each test.
class FilesTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "tenon-files-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }
  void write(const char* name, const std::string& bytes) const { std::ofstream(folder / name) << bytes; }

  std::filesystem::path folder;
};

}  // namespace tenon
