#include <algorithm>
#include <cctype>

#include "tenon/image/picture_file.h"

namespace tenon {

std::optional<PictureFormat> picture_format(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos) return std::nullopt;
  std::string suffix(path.substr(dot));
  std::transform(suffix.begin(), suffix.end(), suffix.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (suffix == ".png") return PictureFormat::png;
  if (suffix == ".exr") return PictureFormat::exr;
  return std::nullopt;
}

std::string_view picture_suffixes() {
  return ".png, .exr";
}

}  // namespace tenon
