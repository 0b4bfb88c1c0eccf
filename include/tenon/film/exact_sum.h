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
  static constexpr double limit() { return power_of_two(limit_exponent); }

  void add(double value) {
    const double size = std::fabs(value);
    // What compares false with everything is to end as 0.
    const double bounded = size < limit() ? size : size >= limit() ? limit() : 0;
    const Integer number = whole(bounded * power_of_two(fraction_bits));
    add_steps(number, value < 0);
  }

  /// The same for a number of single precision: its digits only have to be put in their place, except where they reach
  /// beyond the last one or the limit.
  void add(float value) {
    constexpr int digits = 23, bias = 127;  // of a float: its fraction's digits, its exponent's zero
    constexpr int first_whole = bias + digits - fraction_bits;  // the least exponent of whole steps alone
    constexpr int first_beyond = bias + limit_exponent;         // that of the limit
    const auto bits = std::bit_cast<std::uint32_t>(value);
    const int exponent = static_cast<int>(bits >> digits & 0xffU);
    if (exponent < first_whole || exponent >= first_beyond) return add(static_cast<double>(value));
    const std::uint32_t significand = (bits & ((1U << digits) - 1)) | 1U << digits;
    add_steps(static_cast<Integer>(significand) << (exponent - first_whole), std::signbit(value));
  }
  ExactSum& operator+=(const ExactSum& other) { return units_ += other.units_, *this; }

  double value() const { return static_cast<double>(units_) * power_of_two(-fraction_bits); }
  /// What is added up, in units of 2^-fraction_bits.
  Integer units() const { return units_; }

  friend bool operator==(const ExactSum&, const ExactSum&) = default;

 private:
  static constexpr int limit_exponent =
      static_cast<int>(8 * sizeof(Integer)) - 1 - std::bit_width(most_samples) - fraction_bits;

  // Without branches, for nobody knows which way they would go.
  void add_steps(Integer number, bool is_negative) {
    const Integer sign = -static_cast<Integer>(is_negative);
    units_ += (number ^ sign) - sign;
  }

  static constexpr double power_of_two(int exponent) {
    double power = 1;
    for (int i = 0; i < exponent; ++i) power *= 2;
    for (int i = 0; i > exponent; --i) power /= 2;
    return power;
  }

  // The nearest whole number, ties to even, of one that is not negative; without branches, too.
  static Integer whole(double units) {
    if constexpr (sizeof(Integer) == 8) {
      return static_cast<Integer>(whole_below_2_52(units));
    } else {
      // Digits of 32 bits, but for the highest: what is left after each is exact, so that only the last one rounds.
      const auto high = static_cast<std::int64_t>(units * 0x1p-64);
      const double rest = units - static_cast<double>(high) * 0x1p64;
      const auto middle = static_cast<std::int64_t>(rest * 0x1p-32);
      const std::uint64_t low = whole_below_2_52(rest - static_cast<double>(middle) * 0x1p32);
      return (static_cast<Integer>(high) << 64) +
             ((static_cast<std::uint64_t>(middle) << 32U) + static_cast<Integer>(low));
    }
  }

  // The addition of 2^52 rounds to whole numbers, which then are its lowest bits.
  static std::uint64_t whole_below_2_52(double units) {
    return std::bit_cast<std::uint64_t>(units + 0x1p52) - std::bit_cast<std::uint64_t>(0x1p52);
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
