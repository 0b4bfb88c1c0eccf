#pragma once

#include "math/isolated_roots.h"
#include "primitive/clip.h"
#include "primitive/polynomial3.h"
#include "tenon/math/box3.h"

namespace tenon {

/// What several primitives are: the points of a box where a polynomial is at most 0.
class AlgebraicSolid {
 public:
  enum Face : std::uint32_t { surface, box_faces };  ///< the faces of the box follow, as clip_box numbers them

  AlgebraicSolid() = default;
  AlgebraicSolid(Polynomial3 f, const Box3& box, RootIsolation isolation, RootRefinement refinement)
      : f_(std::move(f)), box_(box), isolation_(isolation), refinement_(refinement) {}

  const Box3& box() const { return box_; }
  void spans(const LocalRay& ray, Spans& out) const;
  Region classify(const LocalBox& box) const;
  Vec3 normal(const Vec3& point, std::uint32_t face) const;

 private:
  template <int N>
  void spans_of_degree(const LocalRay& ray, const Chord& chord, Spans& out) const;

  Polynomial3 f_;
  Box3 box_;
  RootIsolation isolation_ = RootIsolation::interval;
  RootRefinement refinement_ = RootRefinement::newton;
};

}  // namespace tenon
