#include "base/input_file.h"

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace tenon {

namespace {

// Readers count what they find in 32 bits, and anything takes at least a byte.
constexpr std::uintmax_t largest_file = std::uintmax_t{1} << 32;

}  // namespace

Error at_file(const std::string& path, const std::string& message, ErrorKind kind) {
  return Error{kind, message, {path, 0, 0, {}}};
}

Result<InputFile> read_input_file(const std::string& path, const std::string& kind) {
  std::error_code problem;
  if (!std::filesystem::is_regular_file(path, problem)) return at_file(path, "this is no file; name " + kind);
  const std::uintmax_t size = std::filesystem::file_size(path, problem);
  if (problem) return at_file(path, "cannot read it: " + problem.message(), ErrorKind::machine);
  if (size > largest_file) return at_file(path, "files end at 4 GiB; split it");
  InputFile file{path, std::string(static_cast<std::size_t>(size), '\0')};
  std::ifstream stream(path, std::ios::binary);
  stream.read(file.bytes.data(), static_cast<std::streamsize>(size));
  if (!stream) return at_file(path, std::string("cannot read it: ") + std::strerror(errno), ErrorKind::machine);
  return file;
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

}  // namespace tenon
