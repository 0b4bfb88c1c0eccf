#pragma once

#include "tenon/image/light_file.h"

namespace tenon {

/// Reads a Radiance .hdr picture, through stb_image.
Result<LightPicture> read_radiance(const std::string& path);

}  // namespace tenon
