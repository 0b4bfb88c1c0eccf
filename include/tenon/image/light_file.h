#pragma once

#include <string>
#include <vector>

#include "tenon/base/error.h"

namespace tenon {

/// Linear light that was read: three floats a pixel, rows from top to bottom.
struct LightPicture {
  int width = 0, height = 0;
  std::vector<float> rgb;
};

/// Reads linear light: the channels R, G and B of an OpenEXR file (or Y, where it is grey), or a Radiance .hdr file.
/// @return the picture, neither negative nor infinite anywhere, or an input error that names the file
Result<LightPicture> read_light(const std::string& path);

}  // namespace tenon
