#include <cmath>

#include "tenon/scene/scene.h"

namespace tenon {

namespace {

double linear_component(double c) {
  return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

}  // namespace

Rgb linear_from_srgb(const Rgba& color) {
  return {linear_component(color.r), linear_component(color.g), linear_component(color.b)};
}

double srgb_from_linear(double value) {
  return value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055;
}

}  // namespace tenon
