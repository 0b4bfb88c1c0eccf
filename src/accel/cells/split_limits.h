#pragma once

#include <cstddef>

namespace tenon::cells {

/// What keeps a subdivision bounded where splitting cannot help.
struct SplitLimits {
  static constexpr int deepest = 60;
  /// A split pays by itself where it leaves no more than this of the cost.
  static constexpr double least_gain = 0.98;
  /// Where many surfaces run through one point no plane helps; so many splits in a row that leave nearly all leaves on
  /// both sides are tried.
  static constexpr int most_in_vain = 8;
  /// And as long as they do not multiply the leaves beyond this.
  static constexpr std::size_t most_copies = std::size_t{1} << 14;
};

}  // namespace tenon::cells
