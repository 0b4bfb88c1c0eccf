#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "primitive/mesh_bvh.h"
#include "primitive/mesh_line.h"

namespace tenon {

/// A line, or one a lane, in the frame of a hierarchy: at the height h along the axis that it mostly follows, it lies
/// at start + slope * h along the two others. How far it has come is h where it rises, and -h where it falls.
template <class Number>
struct FramedLine {
  Number start[2], slope[2];
  Number growth[2], error[2];  ///< how far it may be from there within the mesh, and how far corners seem to be
  Number up;                   ///< how far along the axis
  Number come_at_0, speed;     ///< how far it has come at t = 0, and from there on, by t
  decltype(Number() < Number()) is_beside;  ///< it misses everything
};

/// The same in single precision.
struct FloatLine {
  std::size_t axes[3];  ///< the one that it mostly follows, and the others
  float start[2], shear[2];
  /// By axis: it meets a plane, near or far side of a box, when it has come plane * inverse - shift. Boxes are grown by
  /// what the line is wrong by.
  float inverse[3], near_shift[3], far_shift[3];
  bool forward[3];
  float error[2];    ///< how far a corner may be from where it is computed, across the line
  float begin, end;  ///< the part that is asked for
  bool is_beside;    ///< it misses everything

  FloatLine(const MeshLine& line, const LineWindow& window, const MeshBvh::Frame& frame);
  /// @param along  the axis that it mostly follows
  /// @param rises  along that
  FloatLine(const FramedLine<double>& line, int along, bool rises, const LineWindow& window)
      : axes{static_cast<std::size_t>(along), static_cast<std::size_t>((along + 1) % 3),
             static_cast<std::size_t>((along + 2) % 3)},
        is_beside(line.is_beside),
        come_at_0_(line.come_at_0),
        speed_(line.speed),
        up_(line.up) {
    // How far the line has come where it meets a plane is wrong by the error of coordinates, across the plane, times
    // the inverse.
    const double sign = rises ? 1 : -1, from = line.come_at_0 + line.speed * window.begin;
    begin = static_cast<float>(std::fabs(from) <= most ? from - line.up : -unknown);
    end_at(window.end);
    set_slab(0, sign, 0, line.up <= most ? line.up : unknown);
    for (std::size_t i = 0; i < 2; ++i) {
      // A slope that takes the line nowhere within the mesh may be any other such.
      constexpr double least = 0x1p-40;
      const double slope = std::fabs(line.slope[i]) < least ? least : line.slope[i];
      start[i] = static_cast<float>(line.start[i]);
      shear[i] = static_cast<float>(slope);
      error[i] = static_cast<float>(line.error[i]);
      set_slab(i + 1, sign / slope, line.start[i], line.growth[i]);
    }
  }

  /// Asks for no more than what lies before t of the line.
  void end_at(double t) {
    const double far = come_at_0_ + speed_ * t + up_;
    end = static_cast<float>(far <= most ? std::max(far, -unknown) : unknown);
  }

  static constexpr double unknown = 0x1p60, most = 0x1p20;
  /// What a float rounds by. No coordinate here is larger than a few units.
  static constexpr double u = 0x1p-24;

 private:
  void set_slab(std::size_t i, double inverse_slope, double place, double grown) {
    forward[i] = inverse_slope > 0;
    const double grow = forward[i] ? grown : -grown;
    inverse[i] = static_cast<float>(inverse_slope);
    near_shift[i] = static_cast<float>((place + grow) * inverse_slope);
    far_shift[i] = static_cast<float>((place - grow) * inverse_slope);
  }

  double come_at_0_, speed_, up_;
};

}  // namespace tenon
