#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace tenon {

/// Part of a picture: columns [x0, x1), rows [y0, y1), counted from the picture's upper left corner.
struct PixelWindow {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(std::max(0, width())) * static_cast<std::size_t>(std::max(0, height()));
  }
  bool contains(int x, int y) const { return x >= x0 && x < x1 && y >= y0 && y < y1; }
  /// Of a pixel inside, row by row.
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x - x0);
  }

  friend bool operator==(const PixelWindow&, const PixelWindow&) = default;
};

/// What lies in both; empty (no pixels) where nothing does.
inline PixelWindow overlap(const PixelWindow& a, const PixelWindow& b) {
  PixelWindow o{std::max(a.x0, b.x0), std::max(a.y0, b.y0), std::min(a.x1, b.x1), std::min(a.y1, b.y1)};
  return o.x0 < o.x1 && o.y0 < o.y1 ? o : PixelWindow{a.x0, a.y0, a.x0, a.y0};
}

/// What is written beside the pixels: a PNG text chunk, an EXR attribute.
struct PictureNote {
  std::string key;   ///< 1 to 79 Latin letters, such as "Software"
  std::string text;  ///< UTF-8

  friend bool operator==(const PictureNote&, const PictureNote&) = default;
};

enum class ChannelType { half, float32, uint32 };

/// A number for each pixel of a window, row by row, under the name that programs know it by, such as "N.X".
struct PictureChannel {
  std::string name;
  ChannelType type = ChannelType::half;
  std::vector<float> values;           ///< of half and float32
  std::vector<std::uint32_t> numbers;  ///< of uint32

  friend bool operator==(const PictureChannel&, const PictureChannel&) = default;
};

/// A picture as OpenEXR keeps one.
struct Picture {
  int width = 0, height = 0;  ///< of the whole picture (the display window)
  PixelWindow window;         ///< the part that is there (the data window)
  std::vector<PictureChannel> channels;
  std::vector<PictureNote> notes;

  /// The channel of this name; null when there is none.
  const PictureChannel* find(std::string_view name) const {
    const auto found =
        std::find_if(channels.begin(), channels.end(), [&](const PictureChannel& c) { return c.name == name; });
    return found == channels.end() ? nullptr : &*found;
  }
  const std::string* note(std::string_view key) const {
    const auto found = std::find_if(notes.begin(), notes.end(), [&](const PictureNote& n) { return n.key == key; });
    return found == notes.end() ? nullptr : &found->text;
  }
};

}  // namespace tenon
