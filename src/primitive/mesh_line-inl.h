// Lines against a mesh, one a lane. Included once for each instruction set.

#if defined(TENON_PRIMITIVE_MESH_LINE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_PRIMITIVE_MESH_LINE_INL_H_
#undef TENON_PRIMITIVE_MESH_LINE_INL_H_
#else
#define TENON_PRIMITIVE_MESH_LINE_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "math/lane_numbers-inl.h"
#include "primitive/mesh_float_line.h"
#include "primitive/mesh_line.h"
#include "tenon/math/rounding.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

/// About 1 / x, from 2^-1000 to 2^1000.
HWY_INLINE double PowerOfTwoOver(double x) {
  const int exponent = static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023;
  return std::bit_cast<double>(static_cast<std::uint64_t>(1023 + std::clamp(-exponent, -1000, 1000)) << 52);
}
HWY_INLINE LaneNumbers PowerOfTwoOver(LaneNumbers x) {
  const LaneNumbers::D d;
  const hn::RebindToUnsigned<LaneNumbers::D> u;
  // 1023 - (e - 1023) of a biased exponent e, and no further from 1023 than by 1000.
  const auto opposite = hn::Sub(hn::Set(u, 2046), hn::ShiftRight<52>(hn::BitCast(u, x.v)));
  const auto least = hn::Set(u, 23), most = hn::Set(u, 2023);
  return LaneNumbers(hn::BitCast(d, hn::ShiftLeft<52>(hn::Min(hn::Max(opposite, least), most))));
}

/// Makes a line, or one a lane, of a ray in the frame of a mesh; see LocalRay.
/// @param line    its `along` is known
/// @param bounds  of the mesh; finite
template <class Number, class Vector>
HWY_INLINE void SetLine(const Vector& origin, const Vector& direction, const Vector& origin_error,
                        const Vector& direction_error, const Box3& bounds, MeshLineOf<Number, Vector>& line) {
  const int along = line.along;
  line.origin = origin;
  line.origin_error = origin_error;
  for (int i = 0; i < 2; ++i) line.across[i] = (along + 1 + i) % 3;
  line.scale = PowerOfTwoOver(magnitude(direction[along]));
  line.direction = line.scale * direction;
  line.direction_error = line.scale * direction_error;

  const Number steep = magnitude(line.direction[along]);
  const Vector reach = max(abs(bounds.lower - origin), abs(bounds.upper - origin));
  // Where the exact line has the coordinate of a point of the mesh, its own t lies this far from 0 at most. A
  // direction of which nothing is known makes everything below infinite, and no triangle certain.
  const Number least = steep - line.direction_error[along];
  const Number farthest = (reach[along] + origin_error[along]) / least * (1 + gamma(4));
  line.farthest = choose(least > Number(0), farthest, Number(Box3::inf));
  const Vector off = origin_error + line.farthest * line.direction_error;
  line.along_error = off[along] / steep * (1 + gamma(4)) + gamma(4) * line.farthest;
  for (int i = 0; i < 2; ++i) {
    const int across = line.across[i];
    line.shear[i] = line.direction[across] / line.direction[along];
    // The difference, the quotient, the product and the sum round once each.
    line.shear_error[i] = (off[across] + magnitude(line.shear[i]) * off[along]) * (1 + gamma(6)) +
                          gamma(6) * (reach[across] + magnitude(line.shear[i]) * reach[along]);
  }
  // What a slab's quotient rounds by, as a distance.
  line.growth = off + gamma(8) * (reach + abs(origin));
}

/// What a float rounds by where a plane is met: the product by 2 u, the shift by 3 u, and the sum by as much as the
/// plane and the start are apart.
template <class Number>
HWY_INLINE Number RoundingAtPlanes(Number up) {
  return 32 * FloatLine::u * (1 + up);
}

/// Takes a line, or one a lane, to the frame of a hierarchy.
template <class Number, class Vector>
HWY_INLINE FramedLine<Number> FrameLine(const MeshLineOf<Number, Vector>& line, const MeshBvh::Frame& frame) {
  using F = FloatLine;
  constexpr double u = F::u;
  const auto limited = [](Number value)
                           HWY_ATTR { return choose(value <= Number(F::most), value, Number(F::unknown)); };
  FramedLine<Number> framed;
  const Vector origin = frame.scale * (line.origin - frame.center), grown = 2 * frame.scale * line.growth;
  framed.up = grown[line.along] + 4 * u;
  const Number sign = choose(line.direction[line.along] > Number(0), Number(1), Number(-1));
  framed.come_at_0 = sign * origin[line.along];
  framed.speed = frame.scale * magnitude(line.direction[line.along]);
  framed.is_beside = Number(0) > Number(0);
  // A mesh lies within 1 of the middle: at heights up to 1.25 no line meets it that passes at 3, if it is known to a
  // quarter.
  constexpr double beside = 3, quarter = 0.25;
  for (int i = 0; i < 2; ++i) {
    const int across = line.across[i];
    const Number at_middle = origin[across] - line.shear[i] * origin[line.along];
    // Of a corner its coordinates, the slope and their product round by u each, the start by 3 u, the differences by
    // 4 u and 5 u. Twice what the line is wrong by covers the rounding in double here and there.
    const Number wrong = 2 * frame.scale * line.shear_error[i];
    const auto is_far = !(magnitude(at_middle) <= Number(beside));
    framed.is_beside =
        framed.is_beside | (is_far & (grown[across] <= Number(quarter)) & (framed.up <= Number(quarter)));
    framed.start[i] = choose(is_far, Number(0), at_middle);
    framed.slope[i] = line.shear[i];
    framed.growth[i] = choose(is_far, Number(F::unknown), limited(grown[across] + RoundingAtPlanes(framed.up)));
    framed.error[i] = choose(is_far, Number(F::unknown), limited(wrong + 20 * u));
  }
  return framed;
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#endif
