#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "tenon/base/error.h"
#include "tenon/image/picture.h"

namespace tenon {

/// A picture as a display gets it: light in [0, 1] where it is to be seen, rows from top to bottom.
struct DisplayPicture {
  int width = 0, height = 0;
  std::span<const float> rgb;    ///< linear light, three a pixel; not weighted with alpha
  std::span<const float> alpha;  ///< one a pixel; empty: the picture is opaque
};

enum class PictureFormat { png, exr };

/// The format that a file's suffix stands for; nothing when it stands for none.
std::optional<PictureFormat> picture_format(std::string_view path);
/// The suffixes there are, for messages: ".png, .exr".
std::string_view picture_suffixes();

/// The file of a picture: sRGB-encoded components, light over 1 clamped (ISO/IEC 15948).
/// @param bits  of each component, 8 or 16
/// @return the bytes, or a machine error
Result<std::string> encode_png(const DisplayPicture& picture, int bits, std::span<const PictureNote> notes);

/// The file of a picture, compressed without loss (OpenEXR): every channel as it is, values beyond the range of a half
/// clamped where the channel is one.
/// @return the bytes, or a machine error
Result<std::string> encode_exr(const Picture& picture);

/// What a PNG or OpenEXR file says beside its pixels: size, window and notes. All of the file is decoded, since only a
/// whole one is of use.
/// @param name  stands for the file in messages
/// @return a picture without channels, or an input error: neither format, damaged or cut off
Result<Picture> decode_head(const std::string& bytes, const std::string& name);

/// Reads an OpenEXR file of one part, scan lines or tiles, with all its channels and text attributes.
/// @param name  stands for the file in messages
/// @return the picture, or an input error: no such file, damaged, or more pixels promised than it can hold
Result<Picture> decode_exr(const std::string& bytes, const std::string& name);

}  // namespace tenon
