#include "image/display_levels.h"

#include <cassert>
#include <cmath>

#include "tenon/math/color.h"

namespace tenon {

namespace {

std::uint8_t level_of(std::uint32_t bits) {
  const auto light = static_cast<double>(std::bit_cast<float>(bits));
  return static_cast<std::uint8_t>(std::lround(255 * srgb_from_linear(light)));
}

}  // namespace

DisplayLevels::DisplayLevels() {
  for (std::uint32_t i = 0; i < parts_.size(); ++i) {
    const std::uint32_t first = (first_index + i) << dropped_bits;
    const std::uint32_t last = first + ((1U << dropped_bits) - 1);
    Part& part = parts_[i];
    part.level = level_of(first);
    if (level_of(last) == part.level) continue;
    assert(level_of(last) == part.level + 1);
    std::uint32_t below = first, above = last;
    while (above - below > 1) {
      const std::uint32_t middle = below + (above - below) / 2;
      (level_of(middle) == part.level ? below : above) = middle;
    }
    part.step = std::bit_cast<float>(above);
  }
}

const DisplayLevels& DisplayLevels::instance() {
  static const DisplayLevels levels;
  return levels;
}

}  // namespace tenon
