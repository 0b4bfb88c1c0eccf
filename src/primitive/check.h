#pragma once

#include <charconv>
#include <cmath>
#include <initializer_list>
#include <string>
#include <string_view>

#include "tenon/math/box3.h"

namespace tenon {

/// Sizes within which no product of four of them overflows or underflows.
inline constexpr double smallest_size = 1e-60;
inline constexpr double largest_size = 1e60;

/// A number as short as it can be and still be read back as the same.
inline std::string shortest(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

struct NamedLength {
  std::string_view field;
  double value;
  bool may_be_zero = false;
};

/// Why lengths make no solid: the first that is not finite, negative, zero, or beyond what double can compute with.
/// Empty when all will do.
inline std::string check_lengths(std::string_view kind, std::initializer_list<NamedLength> lengths) {
  for (const NamedLength& length : lengths) {
    const auto problem = [&](std::string_view what) {
      return std::string(kind) + " with " + std::string(length.field) + " = " + shortest(length.value) + ' ' +
             std::string(what);
    };
    if (!std::isfinite(length.value)) return problem("is not finite");
    if (length.value == 0 && length.may_be_zero) continue;
    if (!(length.value > 0)) return problem("has no volume");
    if (length.value < smallest_size) return problem("is too small to compute with; sizes start at 1e-60");
    if (length.value > largest_size) return problem("is too large to compute with; sizes end at 1e60");
  }
  return {};
}

/// Why a box that clips a primitive will not do. Empty when it does.
inline std::string check_box(std::string_view kind, const Box3& box) {
  if (!box.is_bounded()) return std::string(kind) + " needs a box to end in, [[x, y, z], [x, y, z]]";
  const Vec3 size = box.size();
  if (std::string problem =
          check_lengths(kind, {{"box.size.x", size.x}, {"box.size.y", size.y}, {"box.size.z", size.z}});
      !problem.empty()) {
    return problem;
  }
  return check_lengths(kind, {{"|box|", box.largest_coordinate()}});
}

}  // namespace tenon
