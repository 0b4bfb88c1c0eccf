#pragma once

namespace tenon {

/// Linear light, three bands; not clamped.
struct Rgb {
  double r = 0, g = 0, b = 0;

  friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
  constexpr Rgb& operator+=(const Rgb& o) { return r += o.r, g += o.g, b += o.b, *this; }
};

constexpr Rgb operator+(const Rgb& a, const Rgb& b) {
  return {a.r + b.r, a.g + b.g, a.b + b.b};
}
constexpr Rgb operator*(const Rgb& a, double s) {
  return {a.r * s, a.g * s, a.b * s};
}
constexpr Rgb operator*(double s, const Rgb& a) {
  return a * s;
}
constexpr Rgb operator*(const Rgb& a, const Rgb& b) {
  return {a.r * b.r, a.g * b.g, a.b * b.b};
}

/// A colour as the scene language writes it: sRGB-encoded components in [0, 1], and an opacity.
struct Rgba {
  double r = 0, g = 0, b = 0, a = 1;

  friend constexpr bool operator==(const Rgba&, const Rgba&) = default;
};

/// The light a colour of the scene language stands for (IEC 61966-2-1); its opacity is left out.
Rgb linear_from_srgb(const Rgba& color);

/// A component of linear light as a display expects it, in [0, 1]. Light outside [0, 1] is clamped, NaN is 0.
double srgb_from_linear(double value);

}  // namespace tenon
