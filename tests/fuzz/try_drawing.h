#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "drawing/load_drawing.h"
#include "drawing/svg.h"
#include "primitive/outline_edges.h"

namespace tenon::fuzz {

/// Reads a drawing, and joins its paths. Ends the program where a message is missing or a coordinate is not finite.
inline void try_drawing(const InputFile& file) {
  const auto require = [](bool holds, const char* what) {
    if (holds) return;
    std::fputs(what, stderr);
    std::abort();
  };
  const Result<Drawing> drawing = parse_drawing(file);
  if (!drawing) {
    require(!drawing.error().message.empty() && drawing.error().where.known(), "an error says nothing\n");
    return;
  }
  for (const Stroke& stroke : drawing->strokes) {
    require(std::isfinite(stroke.from.x + stroke.from.y + stroke.to.x + stroke.to.y + stroke.bulge),
            "a stroke is not finite\n");
    require(stroke.layer < drawing->layers.size(), "a stroke lies on no layer\n");
  }
  const DrawnOutline drawn = outline_of_layer(*drawing, "");
  if (check_outline("prism", drawn.outline).empty()) OutlineEdges(drawn.outline).contains({0, 0});
  (void)measure(*drawing, "", "");
  (void)crossing(*drawing, "");
}

/// The same of an SVG file.
inline void try_svg(const InputFile& file) {
  const Result<SvgPicture> picture = read_svg(file, {});
  const bool sound = picture ? true : !picture.error().message.empty() && picture.error().where.known();
  if (!sound) {
    std::fputs("an error says nothing\n", stderr);
    std::abort();
  }
}

}  // namespace tenon::fuzz
