#include "tenon/base/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace tenon {
namespace {

namespace fs = std::filesystem;

class AtomicFileTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (fs::temp_directory_path() / "tenon-atomic-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { fs::remove_all(folder); }

  std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
  }
  static std::string content(const fs::path& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
  }

  fs::path folder;
};

TEST_F(AtomicFileTest, AppearsWhenItIsWhole) {
  const fs::path path = folder / "picture";
  {
    auto file = AtomicFile::create(path);
    ASSERT_TRUE(file.ok());
    ASSERT_TRUE(file->write("half").ok());
    EXPECT_FALSE(fs::exists(path));
    ASSERT_TRUE(file->write(" and half").ok());
    ASSERT_TRUE(file->commit().ok());
  }
  EXPECT_EQ(content(path), "half and half");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, OldFileStaysWhenTheWorkIsGivenUp) {
  const fs::path path = folder / "picture";
  std::ofstream(path) << "old";
  {
    auto file = AtomicFile::create(path);
    ASSERT_TRUE(file.ok());
    ASSERT_TRUE(file->write("new").ok());
  }
  EXPECT_EQ(content(path), "old");
  EXPECT_EQ(files(), 1U);
}

TEST_F(AtomicFileTest, NewFileHasTheUsualMode) {
  const mode_t mask = umask(022);
  auto file = AtomicFile::create(folder / "picture");
  ASSERT_TRUE(file->commit().ok());
  umask(mask);
  struct stat status {};
  ASSERT_EQ(stat((folder / "picture").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0644U);
}

TEST_F(AtomicFileTest, LinkKeepsPointing) {
  std::ofstream(folder / "real") << "old";
  fs::create_symlink("real", folder / "link");
  auto file = AtomicFile::create(folder / "link");
  ASSERT_TRUE(file->write("new").ok());
  ASSERT_TRUE(file->commit().ok());
  EXPECT_TRUE(fs::is_symlink(folder / "link"));
  EXPECT_EQ(content(folder / "real"), "new");
}

TEST_F(AtomicFileTest, PlacesThatCannotBeWrittenAreMachineErrors) {
  for (const fs::path& path : {folder, folder / "no" / "such", fs::path("")}) {
    const auto file = AtomicFile::create(path);
    ASSERT_FALSE(file.ok()) << path;
    EXPECT_EQ(file.error().kind, ErrorKind::machine);
    EXPECT_NE(file.error().message.find("'" + path.string() + "'"), std::string::npos) << file.error().message;
  }
  EXPECT_EQ(files(), 0U);
}

TEST_F(AtomicFileTest, DevicesAreWrittenNotReplaced) {
  auto null = AtomicFile::create("/dev/null");
  ASSERT_TRUE(null.ok());
  EXPECT_TRUE(null->write("x").ok());
  EXPECT_TRUE(null->commit().ok());
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
}

TEST_F(AtomicFileTest, FullDiskIsAMachineError) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  auto full = AtomicFile::create("/dev/full");
  ASSERT_TRUE(full.ok());
  const Status status = full->write("x");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().kind, ErrorKind::machine);
  EXPECT_NE(status.error().message.find("No space left"), std::string::npos);
}

// What a process leaves behind that a signal ends at work.
TEST_F(AtomicFileTest, SignalsRemoveTheTemporaryFile) {
  const auto interrupted = [&] {
    remove_temporary_files_on_signals();
    auto file = AtomicFile::create(folder / "picture");
    if (file.ok()) raise(SIGINT);
    _exit(0);
  };
  EXPECT_EXIT(interrupted(), testing::ExitedWithCode(130), "");
  EXPECT_EQ(files(), 0U);
}

TEST_F(AtomicFileTest, KilledProcessLeavesNothing) {
  const int unnamed = open(folder.c_str(), O_WRONLY | O_TMPFILE, 0600);
  if (unnamed < 0) GTEST_SKIP() << "this file system has no files without names";
  close(unnamed);
  std::ofstream(folder / "picture") << "old";
  const auto killed = [&] {
    auto file = AtomicFile::create(folder / "picture");
    if (file.ok() && file->write("new").ok()) raise(SIGKILL);
    _exit(0);
  };
  EXPECT_EXIT(killed(), testing::KilledBySignal(SIGKILL), "");
  EXPECT_EQ(content(folder / "picture"), "old");
  EXPECT_EQ(files(), 1U);
}

// Of a process that was killed in the moment between naming the file and putting it in place.
TEST_F(AtomicFileTest, NameThatIsTakenIsLeftAlone) {
  const std::string taken = "picture." + std::to_string(getpid()) + ".0";
  std::ofstream(folder / taken) << "another's";
  auto file = AtomicFile::create(folder / "picture");
  ASSERT_TRUE(file.ok() && file->write("new").ok() && file->commit().ok());
  EXPECT_EQ(content(folder / "picture"), "new");
  EXPECT_EQ(content(folder / taken), "another's");
  EXPECT_EQ(files(), 2U);
}

TEST_F(AtomicFileTest, SizeLimitIsAnErrorNotASignal) {
  const auto limited = [&] {
    remove_temporary_files_on_signals();
    const rlimit limit{10, 10};
    setrlimit(RLIMIT_FSIZE, &limit);
    bool failed = false;
    {
      auto file = AtomicFile::create(folder / "picture");
      failed = !file->write(std::string(100, 'x')).ok();
    }
    _exit(failed ? 3 : 0);
  };
  EXPECT_EXIT(limited(), testing::ExitedWithCode(3), "");
  EXPECT_EQ(files(), 0U);
}

}  // namespace
}  // namespace tenon
