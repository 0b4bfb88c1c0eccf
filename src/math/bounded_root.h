#pragma once

namespace tenon {

/// A root as it was computed, and an interval that contains the exact one.
struct BoundedRoot {
  double t = 0;
  double lo = 0;
  double hi = 0;
};

}  // namespace tenon
