#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "primitive/next_crossing.h"

namespace tenon {

/// Rays that may be asked together, at most.
inline constexpr std::size_t most_packet_rays = 64;

/// Rays that are asked together for the first crossings behind t = 0, where they begin: their numbers side by side, ray
/// by ray. Rows begin where vectors of the instructions in use may be loaded from, and what fills the last vector with
/// a ray in it are numbers.
struct RayPacket {
  using Row = const double*;

  std::uint64_t rays = 0;          ///< those that are asked, a bit each
  std::array<Row, 3> origin{};     ///< by axis
  std::array<Row, 3> direction{};  ///< by axis
  Row near = nullptr;              ///< as in CrossingSearch
  Row on_face = nullptr;           ///< the faces that they start on, or -1; none where no ray starts on one
};

/// The same in the frame of a primitive; see LocalRay and Placement::MappedRay.
struct LocalRayPacket {
  using Numbers = std::array<double, most_packet_rays>;

  std::uint64_t rays = 0;
  alignas(64) Numbers shift;
  alignas(64) std::array<Numbers, 3> origin, direction, origin_error, direction_error;
  RayPacket::Row near = nullptr, on_face = nullptr;
};

/// The first crossings of the rays of a packet behind where they begin, by ray; see NextCrossing. Those of which nobody
/// says anything are `unsure`.
struct PacketCrossings {
  bool wants_second = false;  ///< also those behind these
  std::array<NextCrossing, most_packet_rays> first, second;

  void clear() {
    first.fill({});
    second.fill({});
  }
};

/// As many bits as a vector has lanes.
template <std::size_t lanes>
inline constexpr std::uint64_t lanes_mask = (std::uint64_t{1} << lanes) - 1;

}  // namespace tenon
