#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "tenon/image/picture_file.h"

namespace tenon {

namespace {

// A file in memory, as OpenEXR wants one: it goes back to fill in where the rows lie.
class MemoryFile : public Imf::OStream {
 public:
  MemoryFile() : OStream("picture.exr") {}

  void write(const char* data, int size) override {
    const auto n = static_cast<std::size_t>(size);
    if (bytes.size() < position_ + n) bytes.resize(position_ + n);
    std::copy_n(data, n, bytes.begin() + static_cast<std::ptrdiff_t>(position_));
    position_ += n;
  }
  std::uint64_t tellp() override { return position_; }
  void seekp(std::uint64_t position) override { position_ = position; }

  std::string bytes;

 private:
  std::size_t position_ = 0;
};

// Light beyond the range of a half would become infinite, which no viewer shows.
half half_of(float light) {
  return std::clamp(light, -65504.0F, 65504.0F);
}

template <class T, class Convert>
void write_rows(Imf::OutputFile& file, const PictureView& picture, Imf::PixelType type, Convert convert) {
  const std::size_t components = 3 * static_cast<std::size_t>(picture.width);
  std::vector<T> row(components);
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  // A vertical stride of 0: each row is handed over in the same memory.
  for (std::size_t c = 0; c < 3; ++c) {
    frame.insert(names[c], Imf::Slice(type, reinterpret_cast<char*>(row.data() + c), 3 * sizeof(T), 0));
  }
  file.setFrameBuffer(frame);
  for (int y = 0; y < picture.height; ++y) {
    const float* light = picture.rgb.data() + static_cast<std::size_t>(y) * components;
    std::transform(light, light + components, row.begin(), convert);
    file.writePixels(1);
  }
}

}  // namespace

Result<std::string> encode_exr(const PictureView& picture, int bits, std::span<const PictureNote> notes) {
  MemoryFile memory;
  try {
    const Imf::PixelType type = bits == 16 ? Imf::HALF : Imf::FLOAT;
    Imf::Header header(picture.width, picture.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const char* channel : {"R", "G", "B"}) header.channels().insert(channel, Imf::Channel(type));
    for (const PictureNote& note : notes) header.insert(note.key, Imf::StringAttribute(note.text));
    Imf::OutputFile file(memory, header, 0);
    if (bits == 16) {
      write_rows<half>(file, picture, type, half_of);
    } else {
      write_rows<float>(file, picture, type, [](float light) { return light; });
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return Error{ErrorKind::machine, std::string("cannot encode the EXR picture: ") + e.what(), {}};
  }
  return std::move(memory.bytes);
}

}  // namespace tenon
