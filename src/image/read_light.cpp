#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "image/radiance.h"
#include "tenon/image/light_file.h"

namespace tenon {

namespace {

Error at_file(const std::string& path, const std::string& message) {
  return Error{ErrorKind::input, message, {path, 0, 0, {}}};
}

Result<LightPicture> read_exr(const std::string& path) {
  // Larger pictures of the world around would not fit into memory, let alone into view.
  constexpr std::int64_t most_pixels = std::int64_t{1} << 28;
  try {
    Imf::InputFile file(path.c_str());
    const auto window = file.header().dataWindow();
    const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
    const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
    if (width * height > most_pixels) return at_file(path, "it has more than 2^28 pixels; make it smaller");
    const Imf::ChannelList& channels = file.header().channels();
    const bool grey = channels.findChannel("R") == nullptr && channels.findChannel("Y") != nullptr;
    LightPicture picture{static_cast<int>(width), static_cast<int>(height), {}};
    picture.rgb.resize(3 * static_cast<std::size_t>(width * height));
    const char* names[] = {grey ? "Y" : "R", grey ? "Y" : "G", grey ? "Y" : "B"};
    // OpenEXR counts from its window's corner of the whole picture.
    const std::int64_t first = std::int64_t{window.min.x} + std::int64_t{window.min.y} * width;
    for (std::size_t c = 0; c < (grey ? 1 : 3); ++c) {
      if (channels.findChannel(names[c]) == nullptr) {
        return at_file(path, std::string("it has no channel ") + names[c] + "; light has R, G and B");
      }
      Imf::FrameBuffer frame;
      frame.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(picture.rgb.data() + c - 3 * first),
                                        3 * sizeof(float), 3 * sizeof(float) * static_cast<std::size_t>(width)));
      file.setFrameBuffer(frame);
      file.readPixels(window.min.y, window.max.y);
    }
    for (std::size_t i = 0; grey && i < picture.rgb.size(); i += 3) {
      picture.rgb[i + 1] = picture.rgb[i + 2] = picture.rgb[i];
    }
    return picture;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return at_file(path, std::string("cannot read it as an OpenEXR picture: ") + e.what());
  }
}

}  // namespace

Result<LightPicture> read_light(const std::string& path) {
  std::string ending = path.substr(std::min(path.size(), path.rfind('.')));
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".exr" && ending != ".hdr") {
    return at_file(path, "light is read from files that end in .exr or .hdr, not '" + ending + "'");
  }
  Result<LightPicture> picture = ending == ".exr" ? read_exr(path) : read_radiance(path);
  if (!picture) return picture;
  // Neither infinite nor negative light can be drawn from.
  for (float& band : picture->rgb) band = std::isfinite(band) ? std::max(band, 0.0F) : 0.0F;
  return picture;
}

}  // namespace tenon
