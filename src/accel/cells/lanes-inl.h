// Vectors with a number a lane, and numbers as vectors of one lane. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_LANES_INL_H_
#undef TENON_ACCEL_CELLS_LANES_INL_H_
#else
#define TENON_ACCEL_CELLS_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Highway's operations, and the same for one ray: what is written for a ray a lane is compiled for a single one to
/// plain numbers and conditions, which take half the instructions of vectors and masks of one lane.
namespace lanes {

using namespace hwy::HWY_NAMESPACE;

/// The tag of one lane: a double, and a bool as its mask.
struct One {};

template <class D>
struct TypesOf {
  using Vec = hwy::HWY_NAMESPACE::Vec<D>;
  using Mask = hwy::HWY_NAMESPACE::Mask<D>;
};
template <>
struct TypesOf<One> {
  using Vec = double;
  using Mask = bool;
};
template <class D>
using Vec = typename TypesOf<D>::Vec;
template <class D>
using Mask = typename TypesOf<D>::Mask;

using hwy::HWY_NAMESPACE::Abs;
using hwy::HWY_NAMESPACE::Add;
using hwy::HWY_NAMESPACE::AllFalse;
using hwy::HWY_NAMESPACE::AllTrue;
using hwy::HWY_NAMESPACE::And;
using hwy::HWY_NAMESPACE::AndNot;
using hwy::HWY_NAMESPACE::Div;
using hwy::HWY_NAMESPACE::Eq;
using hwy::HWY_NAMESPACE::Ge;
using hwy::HWY_NAMESPACE::GetLane;
using hwy::HWY_NAMESPACE::Gt;
using hwy::HWY_NAMESPACE::IfThenElse;
using hwy::HWY_NAMESPACE::IfThenElseZero;
using hwy::HWY_NAMESPACE::Le;
using hwy::HWY_NAMESPACE::Load;
using hwy::HWY_NAMESPACE::Lt;
using hwy::HWY_NAMESPACE::Max;
using hwy::HWY_NAMESPACE::MaxLanes;
using hwy::HWY_NAMESPACE::Min;
using hwy::HWY_NAMESPACE::Mul;
using hwy::HWY_NAMESPACE::MulAdd;
using hwy::HWY_NAMESPACE::MulSub;
using hwy::HWY_NAMESPACE::Neg;
using hwy::HWY_NAMESPACE::NegMulAdd;
using hwy::HWY_NAMESPACE::Not;
using hwy::HWY_NAMESPACE::Or;
using hwy::HWY_NAMESPACE::Round;
using hwy::HWY_NAMESPACE::Set;
using hwy::HWY_NAMESPACE::Sqrt;
using hwy::HWY_NAMESPACE::Store;
using hwy::HWY_NAMESPACE::StoreMaskBits;
using hwy::HWY_NAMESPACE::Sub;
using hwy::HWY_NAMESPACE::Xor;
using hwy::HWY_NAMESPACE::Zero;

HWY_INLINE constexpr std::size_t MaxLanes(One) {
  return 1;
}
HWY_INLINE double Zero(One) {
  return 0;
}
HWY_INLINE double Set(One, double x) {
  return x;
}
HWY_INLINE double Load(One, const double* from) {
  return *from;
}
HWY_INLINE void Store(double x, One, double* to) {
  *to = x;
}
HWY_INLINE double GetLane(double x) {
  return x;
}

HWY_INLINE double Neg(double x) {
  return -x;
}
HWY_INLINE double Abs(double x) {
  return std::fabs(x);
}
HWY_INLINE double Add(double a, double b) {
  return a + b;
}
HWY_INLINE double Sub(double a, double b) {
  return a - b;
}
HWY_INLINE double Mul(double a, double b) {
  return a * b;
}
HWY_INLINE double Div(double a, double b) {
  return a / b;
}
// As one instruction has them: of what cannot be compared, the second.
HWY_INLINE double Min(double a, double b) {
  return a < b ? a : b;
}
HWY_INLINE double Max(double a, double b) {
  return a > b ? a : b;
}

// What the standard library would have to set errno for, or has no instruction of its own for.
using OneVector = hwy::HWY_NAMESPACE::CappedTag<double, 1>;
HWY_INLINE double Sqrt(double x) {
  return GetLane(Sqrt(Set(OneVector(), x)));
}
HWY_INLINE double Round(double x) {
  return GetLane(Round(Set(OneVector(), x)));
}
HWY_INLINE double MulAdd(double a, double b, double c) {
  const OneVector v;
  return GetLane(MulAdd(Set(v, a), Set(v, b), Set(v, c)));
}
HWY_INLINE double MulSub(double a, double b, double c) {
  return MulAdd(a, b, -c);
}
HWY_INLINE double NegMulAdd(double a, double b, double c) {
  return MulAdd(-a, b, c);
}

HWY_INLINE bool Eq(double a, double b) {
  return a == b;
}
HWY_INLINE bool Lt(double a, double b) {
  return a < b;
}
HWY_INLINE bool Le(double a, double b) {
  return a <= b;
}
HWY_INLINE bool Gt(double a, double b) {
  return a > b;
}
HWY_INLINE bool Ge(double a, double b) {
  return a >= b;
}
HWY_INLINE bool Not(bool a) {
  return !a;
}
HWY_INLINE bool And(bool a, bool b) {
  return a && b;
}
HWY_INLINE bool AndNot(bool a, bool b) {
  return !a && b;
}
HWY_INLINE bool Or(bool a, bool b) {
  return a || b;
}
HWY_INLINE bool Xor(bool a, bool b) {
  return a != b;
}
HWY_INLINE double IfThenElse(bool condition, double a, double b) {
  return condition ? a : b;
}
HWY_INLINE double IfThenElseZero(bool condition, double a) {
  return condition ? a : 0;
}
HWY_INLINE bool AllFalse(One, bool a) {
  return !a;
}
HWY_INLINE bool AllTrue(One, bool a) {
  return a;
}
HWY_INLINE std::size_t StoreMaskBits(One, bool mask, std::uint8_t* bits) {
  *bits = mask ? 1 : 0;
  return 1;
}

/// The largest powers of two that are no greater than positive numbers.
template <class D>
HWY_INLINE Vec<D> PowerOfTwoBelow(D d, Vec<D> x) {
  const RebindToUnsigned<D> u;
  return BitCast(d, And(BitCast(u, x), Set(u, 0x7ff0000000000000)));
}
HWY_INLINE double PowerOfTwoBelow(One, double x) {
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) & 0x7ff0000000000000);
}

}  // namespace lanes

namespace hn = lanes;
using One = lanes::One;

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
