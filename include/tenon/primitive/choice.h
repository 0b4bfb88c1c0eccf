#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace tenon {

/// One of several methods that a primitive can be computed by, or of several meanings of its values, by name.
struct Choice {
  std::uint8_t index = 0;
  std::span<const std::string_view> names;  ///< all there are to choose from

  std::string_view name() const { return names[index]; }
  friend bool operator==(const Choice& a, const Choice& b) { return a.name() == b.name(); }
};

}  // namespace tenon
