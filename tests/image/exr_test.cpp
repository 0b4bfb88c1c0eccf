#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "tenon/image/picture_file.h"

namespace tenon {
namespace {

class MemoryInput : public Imf::IStream {
 public:
  explicit MemoryInput(const std::string& bytes) : IStream("memory"), bytes_(bytes) {}
  bool read(char* out, int size) override {
    std::memcpy(out, bytes_.data() + at_, static_cast<std::size_t>(size));
    at_ += static_cast<std::size_t>(size);
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

struct DecodedExr {
  int width = 0, height = 0;
  Imf::PixelType type = Imf::NUM_PIXELTYPES;
  std::vector<float> rgb;
  std::string software;
};

DecodedExr decode(const std::string& bytes) {
  MemoryInput input(bytes);
  Imf::InputFile file(input);
  DecodedExr decoded;
  const Imath::Box2i window = file.header().dataWindow();
  decoded.width = window.max.x + 1;
  decoded.height = window.max.y + 1;
  decoded.type = file.header().channels()["R"].type;
  if (const auto* note = file.header().findTypedAttribute<Imf::StringAttribute>("Software")) {
    decoded.software = note->value();
  }
  decoded.rgb.resize(3 * static_cast<std::size_t>(decoded.width) * static_cast<std::size_t>(decoded.height));
  Imf::FrameBuffer frame;
  const char* names[] = {"R", "G", "B"};
  for (std::size_t c = 0; c < 3; ++c) {
    frame.insert(names[c], Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(decoded.rgb.data() + c), 3 * sizeof(float),
                                      3 * sizeof(float) * static_cast<std::size_t>(decoded.width)));
  }
  file.setFrameBuffer(frame);
  file.readPixels(0, decoded.height - 1);
  return decoded;
}

std::vector<float> ramp(int width, int height) {
  std::vector<float> rgb;
  for (int i = 0; i < 3 * width * height; ++i) rgb.push_back(0.001F * static_cast<float>(i * i) - 0.5F);
  return rgb;
}

TEST(Exr, FloatRoundTripIsExact) {
  const std::vector<float> rgb = ramp(31, 17);
  const std::vector<PictureNote> notes{{"Software", "tenon 1"}};
  const auto bytes = encode_exr({31, 17, rgb}, 32, notes);
  ASSERT_TRUE(bytes.ok());
  const DecodedExr exr = decode(*bytes);
  EXPECT_EQ(exr.width, 31);
  EXPECT_EQ(exr.height, 17);
  EXPECT_EQ(exr.type, Imf::FLOAT);
  EXPECT_EQ(exr.rgb, rgb);
  EXPECT_EQ(exr.software, "tenon 1");
}

TEST(Exr, HalfRoundsToElevenBitsAndStaysFinite) {
  std::vector<float> rgb = ramp(8, 8);
  rgb[0] = 1e9F;
  rgb[1] = std::numeric_limits<float>::infinity();
  const DecodedExr exr = decode(*encode_exr({8, 8, rgb}, 16, {}));
  EXPECT_EQ(exr.type, Imf::HALF);
  EXPECT_EQ(exr.rgb[0], 65504);
  EXPECT_EQ(exr.rgb[1], 65504);
  for (std::size_t i = 2; i < rgb.size(); ++i) {
    EXPECT_NEAR(exr.rgb[i], rgb[i], std::ldexp(std::fabs(rgb[i]), -11) + 1e-7);
  }
}

TEST(Exr, SameBytesEachTime) {
  const std::vector<float> rgb = ramp(31, 17);
  EXPECT_EQ(*encode_exr({31, 17, rgb}, 16, {}), *encode_exr({31, 17, rgb}, 16, {}));
}

}  // namespace
}  // namespace tenon
