#pragma once

#include <string>
#include <vector>

#include "math/vec2.h"
#include "tenon/base/error.h"
#include "tenon/primitive/outline.h"
#include "text/find_font.h"

namespace tenon {

enum class HorizontalAlignment { left, center, right };
enum class VerticalAlignment { baseline, top, center, bottom };

/// How a line of text is set.
struct TextStyle {
  double size = 10;  ///< about the height of a capital letter: the em is 100/72 of it, as in OpenSCAD
  HorizontalAlignment horizontal = HorizontalAlignment::left;
  VerticalAlignment vertical = VerticalAlignment::baseline;
  double spacing = 1;  ///< factor of the way from each glyph to the next one
  /// "ltr", "rtl", "ttb" or "btt", a language as in "en", a script as in "latin"; found from the text where empty.
  std::string direction, language, script;
  /// Into so many segments a curve of a glyph is cut; 0 for arcs, within 2⁻¹⁴ of the em.
  int segments = 0;
};

/// Glyphs, each stored once, and where they stand.
struct TypesetText {
  struct Place {
    std::size_t glyph = 0;  ///< into `glyphs`
    Vec2 at;
  };
  std::vector<Outline> glyphs;
  std::vector<Place> places;
};

/// Sets a line of text in a font: shaped by HarfBuzz, the outlines by FreeType.
/// @param text  UTF-8
/// @return an error (without place) where the font cannot be read
Result<TypesetText> typeset(const std::string& text, const FontFile& font, const TextStyle& style);

}  // namespace tenon
