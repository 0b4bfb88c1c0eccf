#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace tenon {

/// The levels of a display with 8 bits, by the light that they stand for: round(255 srgb_from_linear(v)), without a
/// power for each component of each pixel.
class DisplayLevels {
 public:
  /// The table that there is one of.
  static const DisplayLevels& instance();

  /// @param light  linear; what is outside [0, 1] is clamped, NaN is 0
  std::uint8_t of(float light) const {
    if (!(light >= lowest)) return 0;
    if (light >= 1) return 255;
    const Part& part = parts_[index_of(light)];
    return static_cast<std::uint8_t>(part.level + (light >= part.step ? 1 : 0));
  }

 private:
  DisplayLevels();

  // Light below rounds to level 0: 255 * 12.92 * 2^-13 < 1/2.
  static constexpr float lowest = 0x1p-13F;
  // A part holds the numbers that agree in their exponent and 7 bits behind the point. Within it v grows by at most
  // v / 128, so the level, whose slope by log v is 255 * 1.055 / 2.4 * v^(1/2.4) at most, rises by less than 0.88:
  // once.
  static constexpr int dropped_bits = 23 - 7;
  static constexpr std::uint32_t first_index = std::bit_cast<std::uint32_t>(lowest) >> dropped_bits;
  static constexpr std::uint32_t end_index = std::bit_cast<std::uint32_t>(1.0F) >> dropped_bits;

  struct Part {
    float step = 2;  // from here on the level is the next one
    std::uint8_t level = 0;
  };

  static std::uint32_t index_of(float light) {
    return (std::bit_cast<std::uint32_t>(light) >> dropped_bits) - first_index;
  }

  std::array<Part, end_index - first_index> parts_;
};

}  // namespace tenon
