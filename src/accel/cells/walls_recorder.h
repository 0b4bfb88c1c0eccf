#pragma once

#include <cmath>
#include <vector>

#include "accel/cells/leaf_records.h"
#include "primitive/wall_part.h"
#include "tenon/math/affine3.h"

namespace tenon::cells {

/// Writes what the records of outlines have in common (WallsRecord).
class WallsRecorder {
 public:
  WallsRecorder() = default;
  /// @param walls, wall_size  where walls begin in the record, and how many numbers each has
  WallsRecorder(std::size_t walls, std::size_t wall_size, const WallPart& part)
      : walls_(walls), wall_size_(wall_size), values_(walls + wall_size * part.walls.size()) {
    values_[WallsRecord::is_inside] = part.is_inside ? 1 : 0;
    values_[WallsRecord::count] = static_cast<double>(part.walls.size());
  }

  std::vector<double>& values() { return values_; }

  /// @param center  of the record
  /// @param map     from there to the leaf's frame
  void put_place(const Vec3& center, const Affine3& map) {
    put(WallsRecord::center, center);
    for (int i = 0; i < 3; ++i) put(WallsRecord::map + static_cast<std::size_t>(3 * i), map.row(i));
  }

  /// Writes the walls, once margins and errors are known.
  /// @param add  called for each wall with where its numbers begin, for what else it has; whether that could be done
  /// @return whether all could be done
  template <class Add>
  bool put_walls(const WallPart& part, const Add& add) {
    using Wall = WallsRecord::Wall;
    std::size_t at = walls_;
    const Vec2 margin{2 * values_[WallsRecord::place_margin], 2 * values_[WallsRecord::place_margin]};
    for (const WallPart::Wall& wall : part.walls) {
      const Vec2 w = wall.chord(), known = part.place - wall.from;
      const double at_place = wall.distance(known);
      // Of an arc of more than half a circle, what is known of its errors does not hold.
      if (!std::isfinite(1 / wall.gradient_length()) || std::fabs(wall.bulge) > 1) return false;
      // The place that is known is told from the wall, with as much again to spare.
      if (!(std::fabs(at_place) > 4 * values_[WallsRecord::place_margin])) return false;
      put(at + Wall::normal, 1 / wall.gradient_length() * wall.normal({}));
      put(at + Wall::chord, 1 / length(w) * w);
      values_[at + Wall::length] = length(w);
      values_[at + Wall::curvature] = wall.bulge / wall.gradient_length();
      put(at + Wall::place, known);
      put(at + Wall::lower, wall.lower - part.place - margin);
      put(at + Wall::upper, wall.upper - part.place + margin);
      values_[at + Wall::at_place] = at_place;
      if (!add(wall, at)) return false;
      at += wall_size_;
    }
    return true;
  }

  void put(std::size_t at, const Vec3& v) {
    for (int i = 0; i < 3; ++i) values_[at + static_cast<std::size_t>(i)] = v[i];
  }
  void put(std::size_t at, const Vec2& v) {
    values_[at] = v.x;
    values_[at + 1] = v.y;
  }

  /// One over the diameter of an arc.
  static double curvature_of(const OutlineEdge& arc) { return std::fabs(arc.bulge) / arc.gradient_length(); }

 private:
  std::size_t walls_ = 0, wall_size_ = 0;
  std::vector<double> values_;
};

}  // namespace tenon::cells
