#include "tenon/image/light_file.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace tenon {
namespace {

std::string place(const std::string& name) {
  return (std::filesystem::temp_directory_path() / ("tenon_light_" + name)).string();
}

// A picture of 3 x 2 pixels whose window begins anywhere.
void write_exr(const std::string& path, const std::vector<std::string>& channels, int x0, int y0) {
  const Imath::Box2i window({x0, y0}, {x0 + 2, y0 + 1});
  Imf::Header header(window, window);
  std::vector<float> values;
  for (int i = 0; i < 6; ++i) {
    for (std::size_t c = 0; c < channels.size(); ++c)
      values.push_back(static_cast<float>(i) + 0.25F * static_cast<float>(c));
  }
  const std::size_t pixel = channels.size() * sizeof(float);
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels.size(); ++c) {
    header.channels().insert(channels[c], Imf::Channel(Imf::FLOAT));
    char* base = reinterpret_cast<char*>(values.data() + c) - static_cast<std::ptrdiff_t>(pixel) * (x0 + 3 * y0);
    frame.insert(channels[c], Imf::Slice(Imf::FLOAT, base, pixel, 3 * pixel));
  }
  Imf::OutputFile file(path.c_str(), header);
  file.setFrameBuffer(frame);
  file.writePixels(2);
}

TEST(ReadLight, ExrOfAnyWindow) {
  const std::string path = place("rgb.exr");
  write_exr(path, {"R", "G", "B"}, -1, 5);
  const auto picture = read_light(path);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_EQ(picture->width, 3);
  EXPECT_EQ(picture->height, 2);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(picture->rgb[3 * i], static_cast<float>(i));
    EXPECT_EQ(picture->rgb[3 * i + 2], static_cast<float>(i) + 0.5F);
  }
  std::filesystem::remove(path);
}

TEST(ReadLight, GreyExrIsWhiteLight) {
  const std::string path = place("y.exr");
  write_exr(path, {"Y"}, 0, 0);
  const auto picture = read_light(path);
  ASSERT_TRUE(picture.ok());
  EXPECT_EQ(picture->rgb[9], 3);
  EXPECT_EQ(picture->rgb[11], 3);
  std::filesystem::remove(path);
}

// Two pixels by hand: mantissas 128, 64, 0 with the exponent 129, and 0, 0, 255 with 128 (Ward's shared exponent; a
// reader may take the middle of a mantissa's step).
TEST(ReadLight, RadianceHdr) {
  const std::string path = place("two.hdr");
  std::ofstream(path, std::ios::binary) << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n"
                                        << std::string("\x80\x40\x00\x81\x00\x00\xff\x80", 8);
  const auto picture = read_light(path);
  ASSERT_TRUE(picture.ok()) << picture.error().message;
  EXPECT_EQ(picture->width, 2);
  EXPECT_NEAR(picture->rgb[0], 1, 1.0 / 128);
  EXPECT_NEAR(picture->rgb[1], 0.5, 1.0 / 128);
  EXPECT_NEAR(picture->rgb[5], 255.0 / 256, 1.0 / 128);
  std::filesystem::remove(path);
}

TEST(ReadLight, AFileThatEndsTooSoonIsAnError) {
  const std::string path = place("short.hdr");
  // Four rows of eight pixels, each component a run of eight; and five rows of seven, which are never encoded.
  std::string encoded = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X 8\n",
              flat = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 5 +X 7\n";
  const std::size_t encoded_header = encoded.size(), flat_header = flat.size();
  for (int row = 0; row < 4; ++row) encoded += std::string("\x02\x02\x00\x08\x88\x70\x88\x60\x88\x50\x88\x81", 12);
  flat.append(5 * 7 * 4, '\x70');
  for (const auto& [whole, header] : {std::pair(encoded, encoded_header), std::pair(flat, flat_header)}) {
    for (std::size_t size = header; size <= whole.size(); ++size) {
      std::ofstream(path, std::ios::binary) << whole.substr(0, size);
      EXPECT_EQ(read_light(path).ok(), size == whole.size()) << size;
    }
  }
  std::filesystem::remove(path);
}

TEST(ReadLight, WhatIsNoLightIsAnErrorOfItsFile) {
  for (const char* name : {"broken.exr", "broken.hdr", "picture.jpg"}) {
    const std::string path = place(name);
    std::ofstream(path, std::ios::binary) << "nothing of the kind";
    const auto picture = read_light(path);
    ASSERT_FALSE(picture.ok());
    EXPECT_EQ(picture.error().kind, ErrorKind::input);
    EXPECT_EQ(picture.error().where.file, path);
    std::filesystem::remove(path);
  }
  EXPECT_FALSE(read_light(place("missing.exr")).ok());
  const std::string path = place("depth.exr");
  write_exr(path, {"Z"}, 0, 0);
  EXPECT_NE(read_light(path).error().message.find("no channel R"), std::string::npos);
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace tenon
