#include "text/typeset.h"

#include <hb-ft.h>
#include <hb.h>

#include <algorithm>
#include <map>
#include <memory>

#include "plane/mapped_outline.h"
#include "text/glyph_outline.h"

#include FT_OUTLINE_H

namespace tenon {

namespace {

template <auto release>
struct Releaser {
  template <class T>
  void operator()(T* object) const {
    release(object);
  }
};
template <class T, auto release>
using Handle = std::unique_ptr<T, Releaser<release>>;

// OpenSCAD asks for `size` points at 100 dots per inch, of which 72 make an inch.
constexpr double em_of_size = 100.0 / 72;

// It divides outlines by 1000, and advances and what it aligns by, which are in 64ths of 16ths, by 1024: lines are a
// little tighter than their font says. Models are made for that.
constexpr double layout_of_outline = 1000.0 / 1024;

/// A face of a font file. Its coordinates are in 64ths of the font's units, and as the font has them: no hints.
class Face {
 public:
  static std::optional<Face> open(const FontFile& file) {
    Face face;
    FT_Library library = nullptr;
    if (FT_Init_FreeType(&library)) return std::nullopt;
    face.library_.reset(library);
    FT_Face outlines = nullptr;
    if (FT_New_Face(library, file.path.c_str(), file.index, &outlines)) return std::nullopt;
    face.outlines_.reset(outlines);
    if (!FT_IS_SCALABLE(outlines) || outlines->units_per_EM == 0) return std::nullopt;
    // FreeType chooses Unicode where the font has it; fonts of symbols have their own codes for the letters.
    if (outlines->charmap == nullptr && FT_Select_Charmap(outlines, FT_ENCODING_MS_SYMBOL) != 0 &&
        outlines->num_charmaps > 0) {
      FT_Set_Charmap(outlines, outlines->charmaps[0]);
    }
    if (FT_Set_Pixel_Sizes(outlines, 0, outlines->units_per_EM)) return std::nullopt;
    face.shapes_.reset(hb_ft_font_create_referenced(outlines));
    hb_ft_font_set_load_flags(face.shapes_.get(), FT_LOAD_NO_HINTING);
    return face;
  }

  double em() const { return 64.0 * outlines_->units_per_EM; }
  hb_font_t* shapes() const { return shapes_.get(); }
  /// Null where there is none.
  FT_Outline* outline(hb_codepoint_t glyph) const {
    if (FT_Load_Glyph(outlines_.get(), glyph, FT_LOAD_NO_HINTING)) return nullptr;
    return outlines_->glyph->format == FT_GLYPH_FORMAT_OUTLINE ? &outlines_->glyph->outline : nullptr;
  }

 private:
  Handle<FT_LibraryRec_, FT_Done_FreeType> library_;
  Handle<FT_FaceRec_, FT_Done_Face> outlines_;
  Handle<hb_font_t, hb_font_destroy> shapes_;
};

Handle<hb_buffer_t, hb_buffer_destroy> shape(const std::string& text, const Face& face, const TextStyle& style) {
  Handle<hb_buffer_t, hb_buffer_destroy> buffer(hb_buffer_create());
  hb_buffer_add_utf8(buffer.get(), text.data(), static_cast<int>(text.size()), 0, static_cast<int>(text.size()));
  const auto length = [](const std::string& s) { return static_cast<int>(s.size()); };
  if (!style.direction.empty()) {
    hb_buffer_set_direction(buffer.get(), hb_direction_from_string(style.direction.data(), length(style.direction)));
  }
  if (!style.language.empty()) {
    hb_buffer_set_language(buffer.get(), hb_language_from_string(style.language.data(), length(style.language)));
  }
  if (!style.script.empty()) {
    hb_buffer_set_script(buffer.get(), hb_script_from_string(style.script.data(), length(style.script)));
  }
  hb_buffer_guess_segment_properties(buffer.get());
  hb_shape(face.shapes(), buffer.get(), nullptr, 0);
  return buffer;
}

/// The extent of a line as OpenSCAD aligns by it.
struct LineExtent {
  double width = 0, ascent = 0, descent = 0;

  void add_horizontal(const FT_BBox& box, double advance) {
    width += advance;
    ascent = std::max(ascent, static_cast<double>(box.yMax));
    descent = std::max(descent, -static_cast<double>(box.yMin));
  }
  void add_vertical(const FT_BBox& box, double advance) {
    width = std::max(width, static_cast<double>(box.xMax - box.xMin));
    ascent += advance;
  }

  Vec2 offset(const TextStyle& style) const {
    Vec2 offset;
    if (style.horizontal == HorizontalAlignment::center) offset.x = -width / 2;
    if (style.horizontal == HorizontalAlignment::right) offset.x = -width;
    if (style.vertical == VerticalAlignment::top) offset.y = -ascent;
    if (style.vertical == VerticalAlignment::center) offset.y = descent / 2 - ascent / 2;
    if (style.vertical == VerticalAlignment::bottom) offset.y = descent;
    return offset;
  }
};

}  // namespace

Result<TypesetText> typeset(const std::string& text, const FontFile& font, const TextStyle& style) {
  const std::optional<Face> face = Face::open(font);
  if (!face) return Error{ErrorKind::machine, "the font file " + font.path + " cannot be read", {}};
  const auto buffer = shape(text, *face, style);
  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* positions = hb_buffer_get_glyph_positions(buffer.get(), &count);
  const bool horizontal = HB_DIRECTION_IS_HORIZONTAL(hb_buffer_get_direction(buffer.get()));
  const double scale = style.size * em_of_size / face->em();

  TypesetText result;
  LineExtent extent;
  std::map<hb_codepoint_t, std::size_t> known;
  Vec2 pen;
  for (unsigned i = 0; i < count; ++i) {
    FT_Outline* outline = face->outline(infos[i].codepoint);
    FT_BBox box{};
    if (outline) FT_Outline_Get_CBox(outline, &box);
    const Vec2 advance =
        style.spacing * Vec2{static_cast<double>(positions[i].x_advance), static_cast<double>(positions[i].y_advance)};
    horizontal ? extent.add_horizontal(box, advance.x) : extent.add_vertical(box, advance.y);
    const auto [place, is_new] = known.try_emplace(infos[i].codepoint, result.glyphs.size());
    if (is_new) {
      const Outline glyph = outline ? glyph_outline(*outline, 0x1p-14 * face->em(), style.segments) : Outline{};
      result.glyphs.push_back(mapped(glyph, Affine3::scale({scale, scale, 1})));
    }
    const Vec2 shift{static_cast<double>(positions[i].x_offset), static_cast<double>(positions[i].y_offset)};
    if (!result.glyphs[place->second].loops.empty()) result.places.push_back({place->second, pen + shift});
    pen = pen + advance;
  }
  const Vec2 offset = extent.offset(style);
  for (TypesetText::Place& place : result.places) place.at = layout_of_outline * scale * (offset + place.at);
  return result;
}

}  // namespace tenon
