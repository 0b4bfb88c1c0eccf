#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "csg/csg_tree.h"
#include "primitive/next_crossing.h"
#include "primitive/ray_packet.h"
#include "tenon/accel/accelerator.h"

namespace tenon::cells {

/// The first crossings of the rays of a batch with leaves that tell them one after another, found for all rays at once.
class BatchCrossings {
 public:
  /// Begins a call, so that what others asked before makes no difference.
  void begin() { due_ = count_ = 0; }
  /// Begins with other rays.
  void clear() { count_ = 0; }

  /// Finds those with a leaf, unless they are known already, or were found of few rays lately.
  /// @param queries       the same rays as those of the packet
  /// @param rays          with the faces that they start on left out
  /// @param wants_second  whether those behind the first ones will be asked for, too
  /// @return of how many rays they are known now that were not before
  int find(const CsgTree& tree, LeafId leaf, std::span<const RayQuery> queries, RayPacket rays, bool wants_second);

  /// The first crossing of a ray with a leaf behind a place, or nothing where it is not known.
  const NextCrossing* behind(LeafId leaf, std::size_t ray, double from) const {
    const PacketCrossings* const found = of(leaf);
    if (found == nullptr) return nullptr;
    const NextCrossing &first = found->first[ray], &second = found->second[ray];
    if (first.kind == NextCrossing::Kind::unsure) return nullptr;
    if (is_behind(first, from)) return &first;
    const bool is_between = from >= first.crossing.t + first.crossing.bound && is_behind(second, from);
    return second.kind != NextCrossing::Kind::unsure && is_between ? &second : nullptr;
  }

 private:
  struct OfLeaf {
    LeafId leaf;
    PacketCrossings found;
  };

  static bool is_behind(const NextCrossing& next, double from) {
    return next.kind == NextCrossing::Kind::nothing || from < next.crossing.t;
  }
  const PacketCrossings* of(LeafId leaf) const {
    for (std::size_t i = 0; i < count_; ++i) {
      if (leaves_[i].leaf == leaf) return &leaves_[i].found;
    }
    return nullptr;
  }

  std::array<OfLeaf, 4> leaves_;
  std::size_t count_ = 0;
  std::size_t due_ = 0;  // times that it is not tried
};

}  // namespace tenon::cells
