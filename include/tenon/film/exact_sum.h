#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace tenon {

__extension__ using Int128 = __int128;

/// The most samples that a pixel may have; sums are wide enough for as many.
inline constexpr std::uint32_t most_samples = 1U << 20U;

/// A sum of many numbers that comes out the same in whatever order they are added, in however many parts: each is
/// rounded once, to a multiple of 2^-fraction_bits, and integers add without rounding. Numbers beyond limit() count as
/// the limit, NaN as 0.
/// @tparam Integer  wide enough for most_samples numbers of limit()
template <class Integer, int fraction_bits>
class ExactSum {
 public:
  ExactSum() = default;
  explicit ExactSum(Integer units) : units_(units) {}

  /// The largest number that counts as it is.
  static constexpr double limit() {
    return power_of_two(static_cast<int>(8 * sizeof(Integer)) - 1 - std::bit_width(most_samples) - fraction_bits);
  }

  void add(double value) {
    // Not clamp(): what compares false with everything is to end as 0.
    const double bounded = value > 0 ? std::min(value, limit()) : value < 0 ? std::max(value, -limit()) : 0;
    const double units = bounded * power_of_two(fraction_bits);
    // From 2^52 on every double is whole, up to 2^63 int64_t holds it, and is sooner made of it than more bits.
    if (std::fabs(units) < 0x1p52) {
      units_ += static_cast<std::int64_t>(std::nearbyint(units));
    } else {
      units_ += std::fabs(units) < 0x1p63 ? static_cast<std::int64_t>(units) : whole(units);
    }
  }
  ExactSum& operator+=(const ExactSum& other) { return units_ += other.units_, *this; }

  double value() const { return static_cast<double>(units_) * power_of_two(-fraction_bits); }
  /// What is added up, in units of 2^-fraction_bits.
  Integer units() const { return units_; }

  friend bool operator==(const ExactSum&, const ExactSum&) = default;

 private:
  static constexpr double power_of_two(int exponent) {
    double power = 1;
    for (int i = 0; i < exponent; ++i) power *= 2;
    for (int i = 0; i > exponent; --i) power /= 2;
    return power;
  }

  // A double of at least 2^52: its significand, shifted.
  static Integer whole(double units) {
    const auto bits = std::bit_cast<std::uint64_t>(std::fabs(units));
    const auto significand = static_cast<Integer>((bits & ((std::uint64_t{1} << 52U) - 1)) | std::uint64_t{1} << 52U);
    const Integer size = significand << (static_cast<int>(bits >> 52U) - 1075);
    return units < 0 ? -size : size;
  }

  Integer units_ = 0;
};

/// Of light and of lengths: steps of 5e-20, up to 4.3e12.
using WideSum = ExactSum<Int128, 64>;
/// Of squares of light: steps of 3.6e-15, up to 2.8e17.
using SquareSum = ExactSum<Int128, 48>;
/// Of shares and components of directions: steps of 9.1e-13, up to 4.
using ShareSum = ExactSum<std::int64_t, 40>;

}  // namespace tenon
