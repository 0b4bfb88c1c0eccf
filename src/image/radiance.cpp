#include "image/radiance.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#include <stb/stb_image.h>

#include <algorithm>
#include <fstream>
#include <memory>

namespace tenon {

namespace {

// A file for stb, which takes zeros for what a file that ends too soon lacks, and waits for ever for a run of some
// length. It asks for what it needs when it needs it, but for a whole buffer, of which it needs a byte.
struct Source {
  std::ifstream file;
  bool ended_early = false;

  static int read(void* source, char* to, int size) {
    auto& s = *static_cast<Source*>(source);
    s.file.read(to, size);
    const auto count = static_cast<int>(s.file.gcount());
    constexpr int buffer = sizeof(stbi__context::buffer_start);
    if (count >= (size == buffer ? 1 : size)) return count;
    s.ended_early = true;
    std::fill(to + count, to + size, '\xff');
    return size;
  }
  static void skip(void* source, int size) { static_cast<Source*>(source)->file.seekg(size, std::ios::cur); }
  static int eof(void* source) { return static_cast<Source*>(source)->file.eof() ? 1 : 0; }
};

}  // namespace

Result<LightPicture> read_radiance(const std::string& path) {
  int width = 0, height = 0, components = 0;
  Source source{std::ifstream(path, std::ios::binary)};
  const stbi_io_callbacks callbacks{Source::read, Source::skip, Source::eof};
  const std::unique_ptr<float, void (*)(void*)> rgb(
      stbi_loadf_from_callbacks(&callbacks, &source, &width, &height, &components, 3), stbi_image_free);
  if (!rgb || source.ended_early) {
    const std::string reason = source.ended_early ? "the file ends too soon" : stbi_failure_reason();
    return Error{ErrorKind::input, "cannot read it as a Radiance picture: " + reason, {path, 0, 0, {}}};
  }
  const std::size_t count = 3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  return LightPicture{width, height, {rgb.get(), rgb.get() + count}};
}

}  // namespace tenon
