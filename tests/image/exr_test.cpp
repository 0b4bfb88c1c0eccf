#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "tenon/image/picture_file.h"

namespace tenon {
namespace {

std::vector<float> ramp(int width, int height) {
  std::vector<float> values;
  for (int i = 0; i < width * height; ++i) values.push_back(0.001F * static_cast<float>(i * i) - 0.5F);
  return values;
}

// Red, green and a number for each pixel of a window of a larger picture.
Picture sample_picture() {
  Picture picture{40, 30, {3, 5, 34, 22}, {}, {{"Software", "tenon 1"}, {"Title", "Würfel.scad"}}};
  picture.channels.push_back({"R", ChannelType::float32, ramp(31, 17), {}});
  picture.channels.push_back({"albedo.G", ChannelType::half, std::vector<float>(31 * 17, 0.25F), {}});
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < 31 * 17; ++i) ids.push_back(i * 0x01234567U);
  picture.channels.push_back({"id", ChannelType::uint32, {}, ids});
  return picture;
}

TEST(Exr, RoundTripKeepsWindowsChannelsAndNotes) {
  const Picture picture = sample_picture();
  const auto bytes = encode_exr(picture);
  ASSERT_TRUE(bytes.ok());
  const auto read = decode_exr(*bytes, "x.exr");
  ASSERT_TRUE(read.ok()) << read.error().message;
  EXPECT_EQ(read->width, 40);
  EXPECT_EQ(read->height, 30);
  EXPECT_EQ(read->window, picture.window);
  EXPECT_EQ(read->channels.size(), 3U);
  for (const PictureChannel& channel : picture.channels) {
    ASSERT_NE(read->find(channel.name), nullptr) << channel.name;
    EXPECT_EQ(*read->find(channel.name), channel) << channel.name;
  }
  ASSERT_NE(read->note("Title"), nullptr);
  EXPECT_EQ(*read->note("Title"), "Würfel.scad");
}

TEST(Exr, HalfRoundsToElevenBitsAndStaysFinite) {
  std::vector<float> values = ramp(24, 8);
  values[0] = 1e9F;
  values[1] = std::numeric_limits<float>::infinity();
  const Picture picture{24, 8, {0, 0, 24, 8}, {{"R", ChannelType::half, values, {}}}, {}};
  const auto read = decode_exr(*encode_exr(picture), "x.exr");
  ASSERT_TRUE(read.ok());
  const PictureChannel& red = *read->find("R");
  EXPECT_EQ(red.type, ChannelType::half);
  EXPECT_EQ(red.values[0], 65504);
  EXPECT_EQ(red.values[1], 65504);
  for (std::size_t i = 2; i < values.size(); ++i) {
    EXPECT_NEAR(red.values[i], values[i], std::ldexp(std::fabs(values[i]), -11) + 1e-7);
  }
}

TEST(Exr, SameBytesEachTime) {
  EXPECT_EQ(*encode_exr(sample_picture()), *encode_exr(sample_picture()));
}

TEST(Exr, DamagedFilesAreInputErrors) {
  const std::string bytes = *encode_exr(sample_picture());
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{4}, std::size_t{100}, bytes.size() / 2, bytes.size() - 1}) {
    const auto read = decode_exr(bytes.substr(0, length), "cut.exr");
    ASSERT_FALSE(read.ok()) << length;
    EXPECT_EQ(read.error().kind, ErrorKind::input);
    EXPECT_NE(read.error().message.find("'cut.exr'"), std::string::npos) << read.error().message;
  }
  // Single bytes changed: an error or some picture, but never a crash.
  for (std::size_t i = 0; i < bytes.size(); i += 7) {
    std::string damaged = bytes;
    damaged[i] = static_cast<char>(damaged[i] ^ 0x55);
    (void)decode_exr(damaged, "damaged.exr").ok();
  }
}

TEST(Exr, PromiseOfMorePixelsThanThereCanBeIsRefused) {
  std::string bytes = *encode_exr(sample_picture());
  // The data window's far corner: 33 becomes a million.
  const std::string corner("\x21\0\0\0\x15\0\0\0", 8);
  const std::size_t at = bytes.find(corner);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 4, std::string("\x40\x42\x0f\0", 4));
  const auto read = decode_exr(bytes, "x.exr");
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().message.find("more pixels"), std::string::npos) << read.error().message;
}

}  // namespace
}  // namespace tenon
