#pragma once

#include <span>
#include <vector>

#include "mesh/triangle_pair.h"

namespace tenon {

/// The surfaces that meet in one edge, as half planes around it.
class EdgeFan {
 public:
  EdgeFan(const Vec3& from, const Vec3& to) : from_(from), to_(to) {}

  /// A triangle that has the edge, or a part of it, for a side; or the part of a triangle's plane on the side of the
  /// edge where `apex` lies.
  /// @param triangle  counterclockwise as seen from outside
  /// @param apex      a corner of it beside the edge
  void add(const Triangle& triangle, const Vec3& apex);
  /// A triangle through whose inside the edge runs: both parts of it.
  void add_both_parts(const Triangle& triangle);

  /// Whether the solids that these surfaces bound overlap beside the edge: as one goes around it, the number of solids
  /// one is in takes three values or more. Where it takes two the solids touch, or one is a hollow in the other.
  /// @return false, too, where the surfaces are not closed around the edge
  bool has_overlap() const;

 private:
  struct Half {
    Vec3 apex;
    int change = 0;  // of the number of solids one is in, counterclockwise
  };

  // In which of four parts around the edge, beginning at the first half: 0 is its direction, 2 the opposite one.
  int part_of(const Half& half) const;

  Vec3 from_, to_;
  std::vector<Half> halves_;
};

}  // namespace tenon
