#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace tenon {

/// What a run of the program left.
struct Outcome {
  int status = -1;  ///< exit status; 128 + signal where one ended it
  std::string out, err;
};

/// Runs the program as a user does, in an empty folder of its own.
class ProgramTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = (std::filesystem::temp_directory_path() / "tenon-test-XXXXXX").string();
    ASSERT_NE(mkdtemp(name.data()), nullptr);
    folder = name;
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name, std::ios::binary) << text;
  }
  std::string read(const std::string& name) const {
    std::ostringstream text;
    text << std::ifstream(folder / name, std::ios::binary).rdbuf();
    return text.str();
  }
  /// How many files lie in the folder, streams of the runs left out.
  std::size_t files() const {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().filename().string().rfind(".stream", 0) != 0) ++count;
    }
    return count;
  }

  /// Starts the program; its streams are the files .stream-in, .stream-out and .stream-err.
  pid_t start(const std::vector<std::string>& arguments, const std::string& input = "") const {
    write(".stream-in", input);
    write(".stream-out", "");
    write(".stream-err", "");
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(folder.c_str()) != 0) _exit(126);
    const auto redirect = [](const char* file, int flags, int stream) { dup2(open(file, flags, 0600), stream); };
    redirect(".stream-in", O_RDONLY, 0);
    redirect(".stream-out", O_WRONLY | O_CREAT | O_TRUNC, 1);
    redirect(".stream-err", O_WRONLY | O_CREAT | O_TRUNC, 2);
    std::vector<char*> argv{const_cast<char*>("tenon")};
    for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
    argv.push_back(nullptr);
    execv(TENON_PROGRAM, argv.data());
    _exit(127);
  }

  Outcome wait_for(pid_t child) const {
    int status = 0;
    waitpid(child, &status, 0);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read(".stream-out"), read(".stream-err")};
  }

  Outcome run(const std::vector<std::string>& arguments, const std::string& input = "") const {
    return wait_for(start(arguments, input));
  }

  std::filesystem::path folder;
};

inline bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace tenon
