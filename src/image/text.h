#pragma once

#include <string>
#include <vector>

namespace tenon {

/// A rectangle of pixels, ends left out.
struct TextBar {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// The size of a line of text, pixels.
/// @param scale  1: letters 7 pixels high
int text_width(const std::string& text, int scale);
inline int text_height(int scale) {
  return 12 * scale;
}

/// The bars that a line of ASCII text is made of (stb_easy_font), its upper left corner at x, y.
std::vector<TextBar> draw_text(const std::string& text, int x, int y, int scale);

}  // namespace tenon
