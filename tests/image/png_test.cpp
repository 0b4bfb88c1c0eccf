#include <gtest/gtest.h>
#include <png.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <memory>

#include "tenon/image/picture_file.h"
#include "tenon/math/color.h"

namespace tenon {
namespace {

struct DecodedPng {
  int width = 0, height = 0, bits = 0;
  std::vector<unsigned> components;
  std::map<std::string, std::string> texts;
  bool is_srgb = false;
};

// Reads a PNG by libpng's own means.
DecodedPng decode(const std::string& bytes) {
  struct Input {
    const std::string* bytes;
    std::size_t at = 0;
  } input{&bytes};
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  png_set_read_fn(png, &input, [](png_structp p, png_bytep out, std::size_t size) {
    auto* in = static_cast<Input*>(png_get_io_ptr(p));
    std::memcpy(out, in->bytes->data() + in->at, size);
    in->at += size;
  });
  png_read_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);

  DecodedPng decoded;
  decoded.width = static_cast<int>(png_get_image_width(png, info));
  decoded.height = static_cast<int>(png_get_image_height(png, info));
  decoded.bits = png_get_bit_depth(png, info);
  decoded.is_srgb = png_get_valid(png, info, PNG_INFO_sRGB) != 0;
  png_bytepp rows = png_get_rows(png, info);
  for (int y = 0; y < decoded.height; ++y) {
    for (int i = 0; i < png_get_channels(png, info) * decoded.width; ++i) {
      decoded.components.push_back(decoded.bits == 8 ? rows[y][i] : rows[y][2 * i] * 256U + rows[y][2 * i + 1]);
    }
  }
  png_textp texts = nullptr;
  const int count = png_get_text(png, info, &texts, nullptr);
  for (int i = 0; i < count; ++i) decoded.texts[texts[i].key] = texts[i].text;
  png_destroy_read_struct(&png, &info, nullptr);
  return decoded;
}

TEST(Png, RoundTripOfEveryByte) {
  // Each of the 256 encoded values, from the light it stands for.
  std::vector<float> rgb;
  for (int v = 0; v < 256; ++v) {
    const Rgb light = linear_from_srgb({v / 255.0, (255 - v) / 255.0, 0.5, 1});
    rgb.insert(rgb.end(), {static_cast<float>(light.r), static_cast<float>(light.g), static_cast<float>(light.b)});
  }
  const auto bytes = encode_png({64, 4, rgb, {}}, 8, {});
  ASSERT_TRUE(bytes.ok());
  const DecodedPng png = decode(*bytes);
  ASSERT_EQ(png.width, 64);
  ASSERT_EQ(png.height, 4);
  ASSERT_EQ(png.bits, 8);
  EXPECT_TRUE(png.is_srgb);
  for (unsigned v = 0; v < 256; ++v) {
    EXPECT_EQ(png.components[3 * v], v);
    EXPECT_EQ(png.components[3 * v + 1], 255 - v);
  }
}

TEST(Png, SixteenBitsKeepFineSteps) {
  std::vector<float> rgb;
  for (int i = 0; i < 300; ++i) rgb.push_back(static_cast<float>(linear_from_srgb({(i * 200 + 7) / 65535.0, 0, 0}).r));
  const auto bytes = encode_png({10, 10, rgb, {}}, 16, {});
  ASSERT_TRUE(bytes.ok());
  const DecodedPng png = decode(*bytes);
  ASSERT_EQ(png.bits, 16);
  for (unsigned i = 0; i < 300; ++i) EXPECT_EQ(png.components[i], i * 200 + 7);
}

TEST(Png, LightOutsideTheRangeIsClamped) {
  const std::vector<float> rgb{-1, 2, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                               0,  1};
  const DecodedPng png = decode(*encode_png({2, 1, rgb, {}}, 8, {}));
  EXPECT_EQ(png.components, (std::vector<unsigned>{0, 255, 0, 255, 0, 255}));
}

TEST(Png, KeepsNotes) {
  const std::vector<PictureNote> notes{{"Software", "tenon 1"}, {"Title", "Würfel.scad"}};
  const DecodedPng png = decode(*encode_png({1, 1, std::vector<float>{0, 0, 0}, {}}, 8, notes));
  EXPECT_EQ(png.texts.at("Software"), "tenon 1");
  EXPECT_EQ(png.texts.at("Title"), "Würfel.scad");
}

TEST(Png, AlphaIsKeptAsItIs) {
  const std::vector<float> rgb{1, 0, 0, 0, 1, 0, 0, 0, 0}, alpha{1, 0.5F, -1};
  const DecodedPng png = decode(*encode_png({3, 1, rgb, alpha}, 8, {}));
  EXPECT_EQ(png.components, (std::vector<unsigned>{255, 0, 0, 255, 0, 255, 0, 128, 0, 0, 0, 0}));
  EXPECT_EQ(decode(*encode_png({3, 1, rgb, alpha}, 16, {})).components[7], 32768U);
}

TEST(DecodeHead, NotesOfWholeFilesAlone) {
  const std::vector<PictureNote> notes{{"Software", "tenon 1"}, {"Title", "Würfel.scad"}};
  const std::vector<float> rgb(3 * 5 * 4, 0.5F);
  Picture picture{5, 4, {1, 1, 4, 4}, {{"R", ChannelType::half, std::vector<float>(9, 0.5F), {}}}, notes};
  for (const bool is_png : {true, false}) {
    const std::string bytes = is_png ? *encode_png({5, 4, rgb, {}}, 8, notes) : *encode_exr(picture);
    const auto head = decode_head(bytes, "x");
    ASSERT_TRUE(head.ok()) << head.error().message;
    EXPECT_EQ(head->width, 5);
    EXPECT_EQ(head->window, (is_png ? PixelWindow{0, 0, 5, 4} : picture.window));
    for (const PictureNote& note : notes) {
      ASSERT_NE(head->note(note.key), nullptr);
      EXPECT_EQ(*head->note(note.key), note.text);
    }
    for (std::size_t size = 0; size < bytes.size(); ++size) {
      EXPECT_FALSE(decode_head(bytes.substr(0, size), "x").ok()) << size << " of " << bytes.size();
    }
  }
}

TEST(PictureFormat, FollowsTheSuffix) {
  EXPECT_EQ(picture_format("a/b.png"), PictureFormat::png);
  EXPECT_EQ(picture_format("a.PNG"), PictureFormat::png);
  EXPECT_EQ(picture_format("a.png.exr"), PictureFormat::exr);
  for (const char* path : {"a", "", ".", "png", "a.jpg", "a.png/b", "a.pngx"})
    EXPECT_FALSE(picture_format(path)) << path;
}

}  // namespace
}  // namespace tenon
