#pragma once

#include <cstdint>

#include "tenon/primitive/crossing.h"

namespace tenon {

/// What is asked of the crossings of a line, one after another.
struct CrossingSearch {
  double begin;  ///< where the ray begins: nothing but the face that it starts on may lie within `near` of it
  double from;   ///< not before `begin`; crossings up to here are passed
  double near;   ///< crossings that are no further apart cannot be told apart
};

/// The first of the crossings of spans() that lie behind a place.
struct NextCrossing {
  enum class Kind : std::uint8_t {
    nothing,  ///< the line crosses the solid's boundary no more: the place is outside
    found,    ///< known to half of `near`, and no other is as near to it as that
    unsure,   ///< the whole of spans() has to tell
  };
  Kind kind = Kind::unsure;
  Crossing crossing;
};

}  // namespace tenon
