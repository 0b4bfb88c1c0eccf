#pragma once

#include <optional>

namespace tenon {

/// What was measured, and how far it may be off, relative.
struct Measured {
  double value = 0;
  double spread = 0;
};

/// Of two that were measured apart: their spreads add up.
inline Measured divided(const Measured& a, const Measured& b) {
  return {a.value / b.value, a.spread + b.spread};
}
inline std::optional<Measured> divided(const std::optional<Measured>& a, const std::optional<Measured>& b) {
  return a && b ? std::optional(divided(*a, *b)) : std::nullopt;
}

}  // namespace tenon
