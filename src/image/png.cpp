#include <png.h>

#include <algorithm>
#include <cmath>
#include <csetjmp>
#include <cstdint>
#include <vector>

#include "image/display_levels.h"
#include "tenon/image/picture_file.h"
#include "tenon/math/color.h"

namespace tenon {

namespace {

// What libpng calls back with. Its errors leave by longjmp, so nothing with a destructor lives in a frame between.
struct PngOutput {
  std::string bytes;
  std::string error;
  bool out_of_memory = false;
};

void on_error(png_structp png, png_const_charp message) {
  static_cast<PngOutput*>(png_get_error_ptr(png))->error = message;
  png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

void on_write(png_structp png, png_bytep data, std::size_t size) {
  auto* out = static_cast<PngOutput*>(png_get_io_ptr(png));
  try {
    out->bytes.append(reinterpret_cast<const char*>(data), size);
  } catch (const std::bad_alloc&) {
    out->out_of_memory = true;
  }
  if (out->out_of_memory) png_error(png, "out of memory");
}

void on_flush(png_structp) {}

bool is_ascii(const std::string& text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
}

// Text chunks are Latin-1 unless they are international ones, which are UTF-8.
std::vector<png_text> text_chunks(std::span<const PictureNote> notes) {
  std::vector<png_text> chunks;
  for (const PictureNote& note : notes) {
    png_text chunk{};
    chunk.compression = is_ascii(note.text) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    chunk.key = const_cast<png_charp>(note.key.c_str());
    chunk.text = const_cast<png_charp>(note.text.c_str());
    chunk.text_length = note.text.size();
    chunks.push_back(chunk);
  }
  return chunks;
}

void put_16(double encoded, std::uint8_t*& out) {
  const auto value = static_cast<std::uint32_t>(std::lround(encoded * 65535));
  *out++ = static_cast<std::uint8_t>(value >> 8U);
  *out++ = static_cast<std::uint8_t>(value & 0xFFU);
}

// A row of pixels, most significant byte first. Alpha is a share, not light: it is not sRGB-encoded.
void encode_row(const DisplayPicture& picture, int y, int bits, std::uint8_t* out) {
  const DisplayLevels& levels = DisplayLevels::instance();
  const std::size_t begin = static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width);
  for (std::size_t i = begin; i < begin + static_cast<std::size_t>(picture.width); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      const float light = picture.rgb[3 * i + c];
      if (bits == 8) {
        *out++ = levels.of(light);
      } else {
        put_16(srgb_from_linear(static_cast<double>(light)), out);
      }
    }
    if (picture.alpha.empty()) continue;
    const double alpha = picture.alpha[i] > 0 ? std::min(1.0, static_cast<double>(picture.alpha[i])) : 0;
    if (bits == 8) {
      *out++ = static_cast<std::uint8_t>(std::lround(alpha * 255));
    } else {
      put_16(alpha, out);
    }
  }
}

// False when libpng gave up. The calls that may jump back here touch nothing but their arguments.
bool write_png(png_structp png, png_infop info, const DisplayPicture& picture, int bits,
               const std::vector<png_text>& chunks, std::vector<std::uint8_t>& row) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;  // NOLINT(cert-err52-cpp)
  png_set_user_limits(png, 0x7FFFFFFF, 0x7FFFFFFF);
  png_set_IHDR(png, info, static_cast<png_uint_32>(picture.width), static_cast<png_uint_32>(picture.height), bits,
               picture.alpha.empty() ? PNG_COLOR_TYPE_RGB : PNG_COLOR_TYPE_RGB_ALPHA, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
  if (!chunks.empty()) png_set_text(png, info, chunks.data(), static_cast<int>(chunks.size()));
  png_write_info(png, info);
  for (int y = 0; y < picture.height; ++y) {
    encode_row(picture, y, bits, row.data());
    png_write_row(png, row.data());
  }
  png_write_end(png, info);
  return true;
}

}  // namespace

Result<std::string> encode_png(const DisplayPicture& picture, int bits, std::span<const PictureNote> notes) {
  PngOutput out;
  const std::vector<png_text> chunks = text_chunks(notes);
  const std::size_t components = picture.alpha.empty() ? 3 : 4;
  std::vector<std::uint8_t> row(components * static_cast<std::size_t>(picture.width) * (bits == 16 ? 2 : 1));

  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &out, on_error, on_warning);
  png_infop info = png != nullptr ? png_create_info_struct(png) : nullptr;
  bool written = false;
  if (info != nullptr) {
    png_set_write_fn(png, &out, on_write, on_flush);
    written = write_png(png, info, picture, bits, chunks, row);
  }
  png_destroy_write_struct(&png, &info);
  if (out.out_of_memory) throw std::bad_alloc();
  if (!written) return Error{ErrorKind::machine, "cannot encode the PNG picture: " + out.error, {}};
  return std::move(out.bytes);
}

}  // namespace tenon
