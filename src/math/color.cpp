#include "tenon/math/color.h"

#include <cmath>

namespace tenon {

namespace {

double linear_component(double encoded) {
  return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace

Rgb linear_from_srgb(const Rgba& color) {
  return {linear_component(color.r), linear_component(color.g), linear_component(color.b)};
}

double srgb_from_linear(double value) {
  if (!(value > 0)) return 0;
  if (value >= 1) return 1;
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace tenon
