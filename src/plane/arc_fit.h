#pragma once

#include <functional>
#include <span>
#include <vector>

#include "math/vec2.h"
#include "tenon/primitive/outline.h"

namespace tenon {

/// A curve by its parameter.
using ParametricCurve = std::function<Vec2(double)>;

/// Appends arcs through points of a curve from parameter `begin` to `end`, the last corner left out, that keep within
/// `tolerance` of it: each is checked at its quarters, and halved until it does.
void fit_arcs(const ParametricCurve& curve, double begin, double end, double tolerance,
              std::vector<OutlineCorner>& loop);

/// Arcs and segments through some of the points that stand close along a closed curve, which keep within `tolerance` of
/// all the others.
std::vector<OutlineCorner> fit_arcs(std::span<const Vec2> points, double tolerance);

}  // namespace tenon
