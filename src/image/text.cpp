#include "image/text.h"

#include <cmath>

#include <stb/stb_easy_font.h>

namespace tenon {

namespace {

// What the font writes for a corner of a bar.
struct FontVertex {
  float x, y, z;
  unsigned char color[4];
};

// stb_easy_font takes text it may change, and does not.
char* writable(const std::string& text) {
  return const_cast<char*>(text.c_str());
}

}  // namespace

int text_width(const std::string& text, int scale) {
  return scale * stb_easy_font_width(writable(text));
}

std::vector<TextBar> draw_text(const std::string& text, int x, int y, int scale) {
  // No letter has more than 16 bars.
  std::vector<FontVertex> vertices(text.size() * 16 * 4);
  const int bars = stb_easy_font_print(0, 0, writable(text), nullptr, vertices.data(),
                                       static_cast<int>(vertices.size() * sizeof(FontVertex)));
  std::vector<TextBar> result;
  for (std::size_t i = 0; i < static_cast<std::size_t>(bars); ++i) {
    const FontVertex &a = vertices[4 * i], &b = vertices[4 * i + 2];
    const auto place = [scale](float v) { return scale * static_cast<int>(std::lround(v)); };
    result.push_back({x + place(a.x), y + place(a.y), x + place(b.x), y + place(b.y)});
  }
  return result;
}

}  // namespace tenon
