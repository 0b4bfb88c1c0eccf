#include "mesh/convex_partition.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tenon {

namespace {

class Partition {
 public:
  Partition(const std::function<bool(const Vec3&)>& is_inside, double same_place, std::size_t most)
      : is_inside_(is_inside), same_place_(same_place), most_(most) {}

  // @return whether all of the cell is inside, and it is one part
  bool cut(const ConvexCell& cell, std::vector<FlatPolygon> walls) {
    const std::size_t first = parts.size();
    if (is_too_many()) return false;
    std::erase_if(walls, [&](const FlatPolygon& wall) { return lies_on_face(cell, wall); });
    while (!walls.empty()) {
      const std::size_t chosen = choose(walls);
      const PlaneSide side{walls[chosen].plane, same_place_};
      const auto behind = cell.behind(side), before = cell.behind(side.reversed());
      if (!behind || !before) {
        // It lies so near to a face that there is nothing between them.
        walls.erase(walls.begin() + static_cast<std::ptrdiff_t>(chosen));
        continue;
      }
      const bool behind_is_full = cut(*behind, clipped(walls, side));
      const bool before_is_full = cut(*before, clipped(walls, side.reversed()));
      if (!behind_is_full || !before_is_full) return false;
      parts.resize(first, cell);
      parts.push_back(cell);
      return true;
    }
    const bool is_full = is_inside_(cell.middle());
    if (is_full) parts.push_back(cell);
    return is_full;
  }

  bool is_too_many() const { return parts.size() > most_; }

  std::vector<ConvexCell> parts;

 private:
  static constexpr std::size_t most_tried = 24;

  bool lies_on_face(const ConvexCell& cell, const FlatPolygon& wall) const {
    return std::any_of(cell.faces().begin(), cell.faces().end(), [&](const FlatPolygon& face) {
      const PlaneSide side{face.plane, same_place_};
      return std::all_of(wall.corners.begin(), wall.corners.end(), [&](const Vec3& p) { return side.of(p) == 0; });
    });
  }

  // The wall whose plane cuts the fewest others, and leaves about as many on each side.
  std::size_t choose(const std::vector<FlatPolygon>& walls) const {
    std::size_t best = 0, least = ~std::size_t{0};
    const std::size_t step = std::max<std::size_t>(1, walls.size() / most_tried);
    for (std::size_t i = 0; i < walls.size(); i += step) {
      const PlaneSide side{walls[i].plane, same_place_};
      std::size_t before = 0, behind = 0, both = 0;
      for (const FlatPolygon& wall : walls) {
        bool is_before = false, is_behind = false;
        for (const Vec3& p : wall.corners) {
          is_before |= side.of(p) > 0;
          is_behind |= side.of(p) < 0;
        }
        before += is_before ? 1 : 0;
        behind += is_behind ? 1 : 0;
        both += is_before && is_behind ? 1 : 0;
      }
      // A wall that is cut becomes two, which cut on: that weighs more than one on the wrong side. It decides how many
      // parts there are, and nothing else.
      const std::size_t cost = 8 * both + std::max(before, behind);
      if (cost < least) best = i;
      least = std::min(least, cost);
    }
    return best;
  }

  // What of the walls lies behind a plane. What lies in it is done with.
  static std::vector<FlatPolygon> clipped(const std::vector<FlatPolygon>& walls, const PlaneSide& side) {
    std::vector<FlatPolygon> rest;
    for (const FlatPolygon& wall : walls) {
      std::vector<Vec3> corners = side.behind(wall.corners);
      if (corners.size() >= 3) rest.push_back({wall.plane, std::move(corners)});
    }
    return rest;
  }

  const std::function<bool(const Vec3&)>& is_inside_;
  const double same_place_;
  const std::size_t most_;
};

}  // namespace

std::optional<std::vector<ConvexCell>> convex_partition(const ConvexCell& whole, std::vector<FlatPolygon> walls,
                                                        const std::function<bool(const Vec3&)>& is_inside,
                                                        double same_place, std::size_t most) {
  Partition partition(is_inside, same_place, most);
  partition.cut(whole, std::move(walls));
  if (partition.is_too_many()) return std::nullopt;
  return std::move(partition.parts);
}

double winding_around(const Vec3& place, const std::vector<Vec3>& points,
                      const std::vector<TriangleMesh::Corners>& triangles) {
  double sum = 0;
  for (const auto& corners : triangles) {
    const Vec3 a = points[corners[0]] - place, b = points[corners[1]] - place, c = points[corners[2]] - place;
    const double la = length(a), lb = length(b), lc = length(c);
    sum += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace tenon
