#pragma once

#include <cstddef>

namespace tenon::cells {

/// What keeps a subdivision bounded where splitting cannot help.
struct SplitLimits {
  static constexpr int deepest = 60;
  /// A split pays by itself where it leaves no more than this of the cost.
  static constexpr double least_gain = 0.98;
  /// A plane beside the middle has to be that much cheaper than the one through it: halves are nearer to cubes, so the
  /// splits that follow find better planes (by trial on the bench).
  static constexpr double least_advantage = 0.97;
  /// Where many surfaces run through one point no plane helps; so many splits in a row that leave nearly all leaves on
  /// both sides are tried.
  static constexpr int most_in_vain = 8;
  /// And as long as they do not multiply the leaves beyond this.
  static constexpr std::size_t most_copies = std::size_t{1} << 14;
};

}  // namespace tenon::cells
