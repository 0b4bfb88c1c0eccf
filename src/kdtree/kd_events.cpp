#include "kdtree/kd_events.h"

#include <algorithm>

namespace tenon {

KdEvents sorted_events(const std::vector<KdFloatItem>& items) {
  KdEvents events;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<KdEvent>& list = events[axis];
    list.reserve(2 * items.size());
    for (std::uint32_t i = 0; i < items.size(); ++i) {
      const float lower = items[i].lower[axis], upper = items[i].upper[axis];
      if (lower == upper) {
        list.push_back({lower, i, KdEventKind::flat});
      } else {
        list.push_back({lower, i, KdEventKind::start});
        list.push_back({upper, i, KdEventKind::end});
      }
    }
    std::sort(list.begin(), list.end(), [](const KdEvent& a, const KdEvent& b) {
      if (a.position != b.position) return a.position < b.position;
      if (a.kind != b.kind) return a.kind < b.kind;
      return a.item < b.item;
    });
  }
  return events;
}

std::optional<KdPlane> find_cheapest_plane(const KdEvents& events, const std::vector<KdFloatItem>& items, double total,
                                           const Box3& cell, const SurfaceAreaHeuristic& heuristic) {
  std::optional<KdPlane> best;
  const auto consider = [&](const KdPlane& plane) {
    if (!best || plane.cost < best->cost) best = plane;
  };
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<KdEvent>& list = events[static_cast<std::size_t>(axis)];
    double below = 0, above = total;
    for (std::size_t i = 0; i < list.size();) {
      // Costs of the items that end at, lie in and start at the next plane.
      const float position = list[i].position;
      std::array<double, 3> at_plane{};
      for (; i < list.size() && list[i].position == position; ++i) {
        at_plane[static_cast<std::size_t>(list[i].kind)] += items[list[i].item].cost;
      }
      const auto [ends, flat, starts] = at_plane;
      above -= ends + flat;
      const double from_lower = static_cast<double>(position) - cell.lower[axis];
      if (from_lower > 0 && static_cast<double>(position) < cell.upper[axis]) {
        const double both = std::max(0.0, below + above + flat - total);
        consider({axis, position, true, heuristic.cost(axis, from_lower, below + flat, above, both)});
        if (flat > 0) consider({axis, position, false, heuristic.cost(axis, from_lower, below, above + flat, both)});
      }
      below += flat + starts;
    }
  }
  return best;
}

}  // namespace tenon
