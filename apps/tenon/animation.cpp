#include "animation.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <filesystem>

namespace tenon {

std::string frame_path(const std::string& output, int frame) {
  std::filesystem::path path(output);
  char number[16];
  std::snprintf(number, sizeof number, "%05d", frame);
  return path.replace_filename(path.stem().string() + number + path.extension().string()).string();
}

std::string frame_definition(int frame, int frames) {
  std::array<char, 32> time{};
  const double t = static_cast<double>(frame) / frames;
  return "$t=" + std::string(time.data(), std::to_chars(time.data(), time.data() + time.size(), t).ptr);
}

}  // namespace tenon
