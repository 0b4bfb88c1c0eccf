#include "accel/cells/spatial_order.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace tenon::cells {

namespace {

constexpr int bits_an_axis = 21;

// Two zeros between each of the lowest 21 bits.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffff;
  bits = (bits | bits << 16) & 0x001f0000ff0000ff;
  bits = (bits | bits << 8) & 0x100f00f00f00f00f;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
  return (bits | bits << 2) & 0x1249249249249249;
}

std::uint64_t morton_key(const Vec3& place, double reach) {
  std::uint64_t key = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double share = std::clamp(0.5 + 0.5 * place[axis] / reach, 0.0, 1.0);
    key |= spread(static_cast<std::uint64_t>(share * ((1 << bits_an_axis) - 1))) << axis;
  }
  return key;
}

}  // namespace

std::vector<LeafId> spatial_order(const CsgTree& tree, double reach) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keys;
  keys.reserve(tree.leaves.size());
  for (std::uint32_t i = 0; i < tree.leaves.size(); ++i) {
    const Box3& bounds = tree.leaves[i].bounds;
    keys.emplace_back(bounds.is_bounded() ? morton_key(bounds.center(), reach) : 0, i);
  }
  std::sort(keys.begin(), keys.end());
  std::vector<LeafId> order;
  order.reserve(keys.size());
  for (const auto& [key, leaf] : keys) order.push_back(LeafId{leaf});
  return order;
}

}  // namespace tenon::cells
