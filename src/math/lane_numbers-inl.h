// Numbers side by side that are written as one. Included once for each instruction set.

#if defined(TENON_MATH_LANE_NUMBERS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_MATH_LANE_NUMBERS_INL_H_
#undef TENON_MATH_LANE_NUMBERS_INL_H_
#else
#define TENON_MATH_LANE_NUMBERS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "tenon/math/vec3.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// A condition of each of some numbers side by side.
struct LaneConditions {
  using D = hn::CappedTag<double, 8>;

  hn::Mask<D> mask;

  /// @param bits  the first number's is the lowest
  static HWY_INLINE LaneConditions from_bits(std::uint32_t bits) {
    const std::uint8_t bytes[8] = {static_cast<std::uint8_t>(bits)};
    return {hn::LoadMaskBits(D(), bytes)};
  }
  HWY_INLINE std::uint32_t bits() const {
    std::uint8_t bytes[8] = {};
    hn::StoreMaskBits(D(), mask, bytes);
    return bytes[0];
  }
  friend HWY_INLINE LaneConditions operator&(LaneConditions a, LaneConditions b) { return {hn::And(a.mask, b.mask)}; }
  friend HWY_INLINE LaneConditions operator|(LaneConditions a, LaneConditions b) { return {hn::Or(a.mask, b.mask)}; }
  friend HWY_INLINE LaneConditions operator!(LaneConditions a) { return {hn::Not(a.mask)}; }
  friend HWY_INLINE bool are_all(LaneConditions a) { return hn::AllTrue(D(), a.mask); }
};

/// As many doubles as a vector holds, up to eight. What is written for a number of either kind, this or a double,
/// rounds the same in both.
struct LaneNumbers {
  using D = LaneConditions::D;
  static constexpr std::size_t count = hn::MaxLanes(D());

  hn::Vec<D> v;

  LaneNumbers() = default;
  HWY_INLINE LaneNumbers(double all) : v(hn::Set(D(), all)) {}
  HWY_INLINE explicit LaneNumbers(hn::Vec<D> numbers) : v(numbers) {}
  /// @param from, to  aligned to a vector
  static HWY_INLINE LaneNumbers load(const double* from) { return LaneNumbers(hn::Load(D(), from)); }
  HWY_INLINE void store(double* to) const { hn::Store(v, D(), to); }

  friend HWY_INLINE LaneNumbers operator+(LaneNumbers a, LaneNumbers b) { return LaneNumbers(hn::Add(a.v, b.v)); }
  friend HWY_INLINE LaneNumbers operator-(LaneNumbers a, LaneNumbers b) { return LaneNumbers(hn::Sub(a.v, b.v)); }
  friend HWY_INLINE LaneNumbers operator*(LaneNumbers a, LaneNumbers b) { return LaneNumbers(hn::Mul(a.v, b.v)); }
  friend HWY_INLINE LaneNumbers operator/(LaneNumbers a, LaneNumbers b) { return LaneNumbers(hn::Div(a.v, b.v)); }
  friend HWY_INLINE LaneNumbers operator-(LaneNumbers a) { return LaneNumbers(hn::Neg(a.v)); }
  friend HWY_INLINE LaneConditions operator<(LaneNumbers a, LaneNumbers b) { return {hn::Lt(a.v, b.v)}; }
  friend HWY_INLINE LaneConditions operator>(LaneNumbers a, LaneNumbers b) { return {hn::Gt(a.v, b.v)}; }
  friend HWY_INLINE LaneConditions operator<=(LaneNumbers a, LaneNumbers b) { return {hn::Le(a.v, b.v)}; }
  friend HWY_INLINE LaneConditions operator>=(LaneNumbers a, LaneNumbers b) { return {hn::Ge(a.v, b.v)}; }
  friend HWY_INLINE LaneConditions operator==(LaneNumbers a, LaneNumbers b) { return {hn::Eq(a.v, b.v)}; }
  friend HWY_INLINE LaneNumbers magnitude(LaneNumbers a) { return LaneNumbers(hn::Abs(a.v)); }
  friend HWY_INLINE LaneNumbers smaller(LaneNumbers a, LaneNumbers b) { return LaneNumbers(hn::Min(a.v, b.v)); }
  friend HWY_INLINE LaneNumbers larger(LaneNumbers a, LaneNumbers b) { return LaneNumbers(hn::Max(a.v, b.v)); }
  friend HWY_INLINE LaneNumbers choose(LaneConditions condition, LaneNumbers a, LaneNumbers b) {
    return LaneNumbers(hn::IfThenElse(condition.mask, a.v, b.v));
  }
};

HWY_INLINE double magnitude(double a) {
  return std::fabs(a);
}
HWY_INLINE double smaller(double a, double b) {
  return std::min(a, b);
}
HWY_INLINE double larger(double a, double b) {
  return std::max(a, b);
}
HWY_INLINE bool are_all(bool condition) {
  return condition;
}
HWY_INLINE double choose(bool condition, double a, double b) {
  return condition ? a : b;
}

/// Vectors side by side: what Vec3 is of doubles.
struct LaneVec3 {
  LaneNumbers x, y, z;

  LaneVec3() = default;
  HWY_INLINE LaneVec3(LaneNumbers its_x, LaneNumbers its_y, LaneNumbers its_z) : x(its_x), y(its_y), z(its_z) {}
  HWY_INLINE LaneVec3(const Vec3& all) : x(all.x), y(all.y), z(all.z) {}

  HWY_INLINE const LaneNumbers& operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }

  friend HWY_INLINE LaneVec3 operator+(const LaneVec3& a, const LaneVec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend HWY_INLINE LaneVec3 operator-(const LaneVec3& a, const LaneVec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend HWY_INLINE LaneVec3 operator*(LaneNumbers s, const LaneVec3& a) { return {a.x * s, a.y * s, a.z * s}; }
  friend HWY_INLINE LaneNumbers dot(const LaneVec3& a, const LaneVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
  friend HWY_INLINE LaneVec3 abs(const LaneVec3& a) { return {magnitude(a.x), magnitude(a.y), magnitude(a.z)}; }
  friend HWY_INLINE LaneVec3 max(const LaneVec3& a, const LaneVec3& b) {
    return {larger(a.x, b.x), larger(a.y, b.y), larger(a.z, b.z)};
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#endif
