#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/base/error.h"

namespace tenon {

/// A picture in memory: linear light, three floats a pixel, rows from top to bottom.
struct PictureView {
  int width = 0, height = 0;
  std::span<const float> rgb;
};

/// What is written beside the pixels: a PNG text chunk, an EXR attribute.
struct PictureNote {
  std::string key;   ///< 1 to 79 Latin letters, such as "Software"
  std::string text;  ///< UTF-8
};

enum class PictureFormat { png, exr };

/// The format that a file's suffix stands for; nothing when it stands for none.
std::optional<PictureFormat> picture_format(std::string_view path);
/// The suffixes there are, for messages: ".png, .exr".
std::string_view picture_suffixes();

/// The file of a picture: sRGB-encoded components, light over 1 clamped (ISO/IEC 15948).
/// @param bits  of each component, 8 or 16
/// @return the bytes, or a machine error
Result<std::string> encode_png(const PictureView& picture, int bits, std::span<const PictureNote> notes);

/// The file of a picture: linear light in the channels R, G and B, compressed without loss (OpenEXR).
/// @param bits  of each component, 16 (half) or 32 (float)
/// @return the bytes, or a machine error
Result<std::string> encode_exr(const PictureView& picture, int bits, std::span<const PictureNote> notes);

}  // namespace tenon
