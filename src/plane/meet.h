#pragma once

#include <optional>

#include "plane/chords.h"

namespace tenon {

/// Where the lines or circles of two curves meet next to a point: the point where one touches the other within
/// `same_place`. Nothing where they do not meet, or are parallel.
std::optional<Vec2> meet(const Curve& a, const Curve& b, const Vec2& near, double same_place);

/// Whether the lines or circles are one, but for `same_place`.
bool are_same_curve(const Curve& a, const Curve& b, double same_place);

}  // namespace tenon
