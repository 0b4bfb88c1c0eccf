#pragma once

#include <type_traits>

namespace tenon {

/// Calls body(axis) for x, y and z, as constants: components of a Vec3 are then found where the code is compiled, which
/// pays where they are asked for all the time.
template <class Body>
constexpr void for_each_axis(const Body& body) {
  body(std::integral_constant<int, 0>{});
  body(std::integral_constant<int, 1>{});
  body(std::integral_constant<int, 2>{});
}

/// Whether body(axis) holds for x, y and z; it is not asked about an axis after one for which it does not.
template <class Body>
constexpr bool holds_for_each_axis(const Body& body) {
  return body(std::integral_constant<int, 0>{}) && body(std::integral_constant<int, 1>{}) &&
         body(std::integral_constant<int, 2>{});
}

}  // namespace tenon
