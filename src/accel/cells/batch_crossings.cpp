#include "accel/cells/batch_crossings.h"

#include <algorithm>
#include <bit>

#include "accel/cells/cell_trace.h"
#include "primitive/dispatch.h"

namespace tenon::cells {

namespace {

// By trial on the bench; they decide nothing but how long rays take. Fewer rays are sooner asked one by one. Beside
// rays that lie too far apart there are mostly others such.
constexpr int fewest_rays = 8;
constexpr std::size_t times_apart = 7;

}  // namespace

int BatchCrossings::find(const CsgTree& tree, LeafId leaf, std::span<const RayQuery> queries, RayPacket rays,
                         bool wants_second) {
  if (of(leaf) != nullptr || count_ == leaves_.size()) return 0;
  leaves_[count_].leaf = leaf;
  PacketCrossings& found = leaves_[count_++].found;
  found.wants_second = wants_second;
  const int asked = std::popcount(rays.rays);
  const bool is_told = asked >= fewest_rays && tells_packets(tree.primitives, tree[leaf].primitive);
  if (!is_told || due_ > 0) {
    if (is_told) --due_;
    found.clear();
    return 0;
  }
  alignas(64) std::array<double, most_packet_rays> on_face;
  if (std::any_of(queries.begin(), queries.end(), [](const RayQuery& query) { return query.from != nullptr; })) {
    on_face.fill(-1);
    for (std::size_t i = 0; i < queries.size(); ++i) on_face[i] = start_face(queries[i], leaf);
    rays.on_face = on_face.data();
  }
  next_crossings(tree.primitives, tree[leaf].primitive, tree[leaf].placement, rays, tree.tolerance.distance, found);
  const auto is_known = [](const NextCrossing& next) { return next.kind != NextCrossing::Kind::unsure; };
  const auto known = static_cast<int>(std::count_if(found.first.begin(), found.first.end(), is_known));
  if (2 * known < asked) due_ = times_apart;
  return known;
}

}  // namespace tenon::cells
