#pragma once

#include <optional>
#include <string_view>

#include "tenon/primitive/outline.h"

namespace tenon {

/// The loops of the `d` attribute of an SVG path, each closed. Circular arcs are arcs; other curves become arcs within
/// 2⁻¹⁶ of their size.
/// @return nothing where the text is no path data
std::optional<Outline> parse_svg_path(std::string_view data);

}  // namespace tenon
