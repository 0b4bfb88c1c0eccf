#pragma once

#include <optional>

#include "lang/value.h"
#include "tenon/math/color.h"

namespace tenon::lang {

/// A colour by its CSS name (in any case), as "#rgb", "#rgba", "#rrggbb" or "#rrggbbaa", or as a list of three or four
/// numbers; null for anything else.
std::optional<Rgba> to_color(const Value& value);

/// The colour of a CSS name in lower case.
std::optional<Rgba> named_color(std::string_view name);

}  // namespace tenon::lang
