#include "image/radiance.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#include <stb/stb_image.h>

#include <memory>

namespace tenon {

Result<LightPicture> read_radiance(const std::string& path) {
  int width = 0, height = 0, components = 0;
  const std::unique_ptr<float, void (*)(void*)> rgb(stbi_loadf(path.c_str(), &width, &height, &components, 3),
                                                    stbi_image_free);
  if (!rgb) {
    return Error{ErrorKind::input,
                 std::string("cannot read it as a Radiance picture: ") + stbi_failure_reason(),
                 {path, 0, 0, {}}};
  }
  const std::size_t count = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return LightPicture{width, height, {rgb.get(), rgb.get() + count}};
}

}  // namespace tenon
