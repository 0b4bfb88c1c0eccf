#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cstdint>
#include <cstring>
#include <new>
#include <stdexcept>

#include "image/exr_types.h"
#include "tenon/image/picture_file.h"

namespace tenon {

namespace {

class MemoryFile : public Imf::IStream {
 public:
  explicit MemoryFile(const std::string& bytes, const std::string& name) : IStream(name.c_str()), bytes_(bytes) {}

  bool read(char* out, int size) override {
    const auto n = static_cast<std::size_t>(size);
    if (position_ > bytes_.size() || n > bytes_.size() - position_) throw std::runtime_error("it ends too early");
    std::memcpy(out, bytes_.data() + position_, n);
    position_ += n;
    return position_ < bytes_.size();
  }
  std::uint64_t tellg() override { return position_; }
  void seekg(std::uint64_t position) override { position_ = position; }

 private:
  const std::string& bytes_;
  std::size_t position_ = 0;
};

// Deflate shrinks nothing to less than one 1032nd (RFC 1951: a code of one bit twice, for 258 bytes), and OpenEXR's
// other methods do not reach that. A header that promises more would have us fill memory for nothing.
constexpr std::uint64_t most_compression = 1032;

void read_channels(Imf::InputFile& file, Picture& picture) {
  const PixelWindow& window = picture.window;
  Imf::FrameBuffer frame;
  const Imf::ChannelList& channels = file.header().channels();
  for (auto c = channels.begin(); c != channels.end(); ++c) {
    if (c.channel().xSampling != 1 || c.channel().ySampling != 1) throw std::runtime_error("a channel is subsampled");
    PictureChannel& channel = picture.channels.emplace_back();
    channel.name = c.name();
    channel.type = channel_type(c.channel().type);
  }
  const std::ptrdiff_t stride = 4 * static_cast<std::ptrdiff_t>(window.width());
  for (PictureChannel& channel : picture.channels) {
    char* first = nullptr;
    if (channel.type == ChannelType::uint32) {
      channel.numbers.resize(window.pixels());
      first = reinterpret_cast<char*>(channel.numbers.data());
    } else {
      channel.values.resize(window.pixels());
      first = reinterpret_cast<char*>(channel.values.data());
    }
    // Halves are read as floats.
    frame.insert(channel.name, Imf::Slice(channel.type == ChannelType::uint32 ? Imf::UINT : Imf::FLOAT,
                                          first - 4 * static_cast<std::ptrdiff_t>(window.x0) - window.y0 * stride, 4,
                                          static_cast<std::size_t>(stride)));
  }
  file.setFrameBuffer(frame);
  file.readPixels(window.y0, window.y1 - 1);
}

}  // namespace

Result<Picture> decode_exr(const std::string& bytes, const std::string& name) {
  try {
    MemoryFile memory(bytes, name);
    Imf::InputFile file(memory, 0);
    const Imf::Header& header = file.header();
    const Imath::Box2i display = header.displayWindow(), data = header.dataWindow();
    std::uint64_t bytes_per_pixel = 0;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
      bytes_per_pixel += c.channel().type == Imf::HALF ? 2 : 4;
    }
    const double pixels = (1.0 + data.max.x - data.min.x) * (1.0 + data.max.y - data.min.y);
    if (pixels * static_cast<double>(bytes_per_pixel) > static_cast<double>(most_compression * bytes.size())) {
      throw std::runtime_error("its header promises more pixels than it can hold");
    }
    if (display.min.x != 0 || display.min.y != 0) throw std::runtime_error("its display window does not begin at 0, 0");

    Picture picture;
    picture.width = display.max.x + 1;
    picture.height = display.max.y + 1;
    picture.window = {data.min.x, data.min.y, data.max.x + 1, data.max.y + 1};
    for (auto a = header.begin(); a != header.end(); ++a) {
      if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute())) {
        picture.notes.push_back({a.name(), text->value()});
      }
    }
    read_channels(file, picture);
    return picture;
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    return Error{ErrorKind::input, "'" + name + "' is no EXR picture that can be read: " + e.what(), {}};
  }
}

}  // namespace tenon
