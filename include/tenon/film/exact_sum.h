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
    units_ += whole(units);
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

  // The nearest whole number, ties to even; without branches, for nobody knows which way they would go. From 2^52 on
  // every double is whole, and it is below 2^52 that the addition of 2^52 rounds.
  static Integer whole(double units) {
    const double size = std::fabs(units);
    const double rounded = size < 0x1p52 ? (size + 0x1p52) - 0x1p52 : size;
    const auto bits = std::bit_cast<std::uint64_t>(rounded);
    const std::uint64_t significand = (bits & ((std::uint64_t{1} << 52U) - 1)) | std::uint64_t{1} << 52U;
    const int shift = static_cast<int>(bits >> 52U) - 1075;  // of 0 it is so far below that nothing is left
    const auto number = static_cast<Integer>(significand >> std::clamp(-shift, 0, 63)) << std::max(shift, 0);
    const Integer sign = -static_cast<Integer>(units < 0);
    return (number ^ sign) - sign;
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
