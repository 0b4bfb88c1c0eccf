#include "lang/source_files.h"

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "lang/failure.h"

namespace tenon::lang {

namespace {

namespace fs = std::filesystem;

// Offsets are 32 bits wide; half of that is far above any scene written or generated.
constexpr std::size_t largest_file = std::size_t{1} << 31;

struct CloseFile {
  void operator()(std::FILE* file) const { std::fclose(file); }
};

std::string read_all(std::FILE* file, const std::string& path, Place named_at) {
  std::string text;
  std::vector<char> chunk(1 << 16);
  while (const std::size_t n = std::fread(chunk.data(), 1, chunk.size(), file)) {
    // Found per chunk, so that endless binary devices end too.
    if (std::memchr(chunk.data(), 0, n)) {
      fail(named_at, "'" + path + "' is not a text file; give a scene file (.scad or .csg)");
    }
    text.append(chunk.data(), n);
    if (text.size() > largest_file) fail(named_at, "'" + path + "' is larger than 2 GiB; split it with include");
  }
  if (std::ferror(file)) {
    fail(named_at, "cannot read '" + path + "': " + std::strerror(errno), ErrorKind::machine);
  }
  return text;
}

std::vector<fs::path> library_folders() {
  std::vector<fs::path> folders;
  if (const char* list = std::getenv("OPENSCADPATH")) {
    std::string rest = list;
    while (!rest.empty()) {
      const std::size_t colon = rest.find(':');
      if (colon != 0) folders.emplace_back(rest.substr(0, colon));
      rest = colon == std::string::npos ? "" : rest.substr(colon + 1);
    }
  }
  if (const char* home = std::getenv("HOME")) folders.push_back(fs::path(home) / ".local/share/OpenSCAD/libraries");
  folders.emplace_back("/usr/share/openscad/libraries");
  return folders;
}

}  // namespace

const SourceText& SourceFiles::read(const std::string& path, Place named_at) {
  if (path == "-") return add("<stdin>", "", read_all(stdin, "standard input", named_at));
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) fail(named_at, "'" + path + "' is a directory; give a scene file");
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(path.c_str(), "rb"));
  if (!file) {
    fail(named_at, errno == ENOENT ? "there is no file '" + path + "'; check the path"
                                   : "cannot open '" + path + "': " + std::strerror(errno));
  }
  return add(path, fs::path(path).parent_path().string(), read_all(file.get(), path, named_at));
}

const SourceText& SourceFiles::add(std::string name, std::string directory, std::string text) {
  return texts_.emplace_back(std::move(name), std::move(directory), std::move(text));
}

std::string SourceFiles::find(const std::string& name, Place named_at) {
  const fs::path wanted(name);
  std::error_code ignored;
  if (wanted.is_absolute()) return name;
  const fs::path beside = fs::path(named_at.source->directory) / wanted;
  if (fs::exists(beside, ignored)) return beside.string();
  for (const fs::path& folder : library_folders()) {
    if (fs::exists(folder / wanted, ignored)) return (folder / wanted).string();
  }
  fail(named_at, "there is no file '" + name +
                     "' beside this one or in a library folder; check the name, or add its folder to OPENSCADPATH");
}

}  // namespace tenon::lang
