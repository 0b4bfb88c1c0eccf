#pragma once

#include <algorithm>
#include <vector>

#include "accel/cells/certainty.h"
#include "accel/cells/leaf_records.h"

namespace tenon::cells {

/// Makes a ConvexRecord of planes in a leaf's frame.
class PlanesRecorder {
 public:
  /// A plane that is met at a slope below the least is left to the exact structure when it might be met in the scene.
  /// Larger than this, too many rays would be.
  static constexpr double most_slope = 0x1p-9;

  /// @param center  what the record's places are relative to
  PlanesRecorder(const Leaf& leaf, const CellScale& scale, const Vec3& center)
      : placement_(leaf.placement), certainty_(leaf, scale), center_(center) {}

  /// @param error  of the distance to it that spans() computes, but for what comes from the ray
  void add(const Plane& plane, double error) {
    const Vec3 n = placement_.local_from_world_linear().transposed_direction(plane.normal);
    const double scale = length(n);
    const double d = plane.d + dot(n, placement_.world_origin() - center_);
    for (const double v : {n.x / scale, n.y / scale, n.z / scale, d / scale}) values_.push_back(v);
    const double of_ray = dot(abs(plane.normal), certainty_.place());
    values_[ConvexRecord::least] = std::max(least_slope(), certainty_.least_slope(of_ray + error) / scale);
    values_[ConvexRecord::count] += 1;
  }

  /// Makes it the record of a notch.
  void invert() { values_[ConvexRecord::count] *= -1; }

  double least_slope() const { return values_[ConvexRecord::least]; }
  /// Where the numbers of a ConvexRecord stand.
  const std::vector<double>& values() const { return values_; }

 private:
  const Placement& placement_;
  const Certainty certainty_;
  const Vec3 center_;
  std::vector<double> values_ = std::vector<double>(ConvexRecord::planes);
};

/// Adds a record. @return its index
template <class Lines>
std::size_t append_values(const std::vector<double>& values, Lines& lines) {
  const std::size_t first = lines.size();
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i % 8 == 0) lines.emplace_back();
    lines.back().values[i % 8] = values[i];
  }
  return first;
}

}  // namespace tenon::cells
