#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace tenon {

/// Why a ray is traced.
enum class RayKind : std::uint8_t { primary, shadow, reflected, refracted, diffuse };
inline constexpr std::size_t ray_kind_count = 5;
inline constexpr std::array<std::string_view, ray_kind_count> ray_kind_names{"primary", "shadow", "reflected",
                                                                             "refracted", "diffuse"};

/// What a structure did for the rays of one kind.
struct TraversalCounters {
  std::uint64_t rays = 0;
  std::uint64_t primitive_tests = 0;  ///< rays intersected with a primitive
  std::uint64_t cells_visited = 0;    ///< cells, boxes or nodes entered
  std::uint64_t next_box_calls = 0;   ///< steps from one cell to the next
  std::uint64_t mailbox_hits = 0;     ///< tests answered by the mailbox instead

  TraversalCounters& operator+=(const TraversalCounters& o) {
    rays += o.rays;
    primitive_tests += o.primitive_tests;
    cells_visited += o.cells_visited;
    next_box_calls += o.next_box_calls;
    mailbox_hits += o.mailbox_hits;
    return *this;
  }
};

/// Counters of one thread, by kind of ray; added up when a picture is done.
struct TraversalStatistics {
  std::array<TraversalCounters, ray_kind_count> by_kind;
  std::uint64_t seam_faults = 0;  ///< a primitive revealed late changed the solid: always 0, or a structure is wrong

  TraversalCounters& operator[](RayKind kind) { return by_kind[static_cast<std::size_t>(kind)]; }
  const TraversalCounters& operator[](RayKind kind) const { return by_kind[static_cast<std::size_t>(kind)]; }

  TraversalCounters total() const {
    TraversalCounters sum;
    for (const TraversalCounters& c : by_kind) sum += c;
    return sum;
  }
  TraversalStatistics& operator+=(const TraversalStatistics& o) {
    for (std::size_t i = 0; i < ray_kind_count; ++i) by_kind[i] += o.by_kind[i];
    seam_faults += o.seam_faults;
    return *this;
  }
};

}  // namespace tenon
