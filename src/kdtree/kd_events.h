#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "kdtree/kd_tree.h"
#include "kdtree/surface_area_heuristic.h"

namespace tenon {

/// A place where the items on either side of a plane change. In this order where several share a place, so that what
/// ends there is gone, and what begins there is not yet counted (Wald & Havran 2006, §4.2).
enum class KdEventKind : std::uint8_t { end, flat, start };

struct KdEvent {
  float position;
  std::uint32_t item;  ///< index among the items the tree is built over
  KdEventKind kind;
};

/// The events along each axis, sorted.
using KdEvents = std::array<std::vector<KdEvent>, 3>;

/// An item's box in floats, rounded outward, and its cost.
struct KdFloatItem {
  std::array<float, 3> lower, upper;
  double cost;
};

/// A splitting plane and what it would cost.
struct KdPlane {
  int axis = 0;
  float position = 0;
  bool flat_below = true;  ///< where items lying in the plane go
  double cost = 0;
};

/// Sorted events of all items.
KdEvents sorted_events(const std::vector<KdFloatItem>& items);

/// The cheapest plane strictly within the cell, among the bounds of the items; one pass over the events.
/// @param total  the cost of all items the events belong to
std::optional<KdPlane> find_cheapest_plane(const KdEvents& events, const std::vector<KdFloatItem>& items, double total,
                                           const Box3& cell, const SurfaceAreaHeuristic& heuristic);

}  // namespace tenon
