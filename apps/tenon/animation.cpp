#include "animation.h"

#include <cstdio>
#include <filesystem>

#include "numbers.h"

namespace tenon {

std::string frame_path(const std::string& output, int frame) {
  std::filesystem::path path(output);
  char number[16];
  std::snprintf(number, sizeof number, "%05d", frame);
  return path.replace_filename(path.stem().string() + number + path.extension().string()).string();
}

std::string frame_definition(int frame, int frames) {
  return "$t=" + shortest(static_cast<double>(frame) / frames);
}

}  // namespace tenon
