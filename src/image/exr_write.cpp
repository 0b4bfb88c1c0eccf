#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <vector>

#include "image/exr_types.h"
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

std::vector<half> halves_of(const std::vector<float>& values) {
  std::vector<half> halves(values.size());
  std::transform(values.begin(), values.end(), halves.begin(), half_of);
  return halves;
}

// OpenEXR finds pixel (x, y) at base + x * size + y * stride, with x and y of the whole picture.
Imf::Slice slice_of(Imf::PixelType type, const void* first, std::size_t size, const PixelWindow& window) {
  const std::size_t stride = size * static_cast<std::size_t>(window.width());
  const std::ptrdiff_t before = static_cast<std::ptrdiff_t>(window.x0) * static_cast<std::ptrdiff_t>(size) +
                                static_cast<std::ptrdiff_t>(window.y0) * static_cast<std::ptrdiff_t>(stride);
  return {type, static_cast<char*>(const_cast<void*>(first)) - before, size, stride};
}

}  // namespace

Result<std::string> encode_exr(const Picture& picture) {
  MemoryFile memory;
  try {
    const Imath::Box2i display({0, 0}, {picture.width - 1, picture.height - 1});
    const Imath::Box2i data({picture.window.x0, picture.window.y0}, {picture.window.x1 - 1, picture.window.y1 - 1});
    Imf::Header header(display, data);
    header.compression() = Imf::ZIP_COMPRESSION;
    std::vector<std::vector<half>> halves;
    halves.reserve(picture.channels.size());
    Imf::FrameBuffer frame;
    for (const PictureChannel& channel : picture.channels) {
      const Imf::PixelType type = exr_type(channel.type);
      header.channels().insert(channel.name, Imf::Channel(type));
      const void* first = channel.values.data();
      if (channel.type == ChannelType::half) first = halves.emplace_back(halves_of(channel.values)).data();
      if (channel.type == ChannelType::uint32) first = channel.numbers.data();
      frame.insert(channel.name, slice_of(type, first, channel.type == ChannelType::half ? 2 : 4, picture.window));
    }
    for (const PictureNote& note : picture.notes) header.insert(note.key, Imf::StringAttribute(note.text));
    Imf::OutputFile file(memory, header, 0);
    file.setFrameBuffer(frame);
    file.writePixels(picture.window.height());
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return Error{ErrorKind::machine, std::string("cannot encode the EXR picture: ") + e.what(), {}};
  }
  return std::move(memory.bytes);
}

}  // namespace tenon
