#pragma once

#include <array>
#include <charconv>
#include <string>
#include <string_view>

#include "tenon/math/affine3.h"
#include "tenon/math/color.h"

namespace tenon {

/// Text of POV-Ray's scene language.
class PovText {
 public:
  PovText& operator<<(std::string_view text) {
    text_ += text;
    return *this;
  }
  /// The shortest text that reads back to the same double; the sign of a zero means nothing.
  PovText& operator<<(double value) {
    std::array<char, 32> text{};
    text_.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value + 0.0).ptr);
    return *this;
  }
  PovText& operator<<(const Vec3& v) { return *this << "<" << v.x << ", " << v.y << ", " << v.z << ">"; }
  PovText& operator<<(const Rgb& c) { return *this << "rgb " << Vec3{c.r, c.g, c.b}; }
  /// A matrix as POV-Ray has it: the images of the axes, then that of the origin.
  PovText& operator<<(const Affine3& map) {
    *this << "matrix <";
    for (int column = 0; column < 3; ++column) {
      const Vec3 image = map.column(column);
      *this << image.x << ", " << image.y << ", " << image.z << ", ";
    }
    const Vec3 origin = map.translation();
    return *this << origin.x << ", " << origin.y << ", " << origin.z << ">";
  }

  std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace tenon
