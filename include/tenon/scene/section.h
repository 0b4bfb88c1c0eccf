#pragma once

#include <optional>
#include <vector>

#include "tenon/math/vec3.h"

namespace tenon {

/// A plane of a section view: it may take away the points p with normal·p > d.
struct SectionPlane {
  Vec3 normal;              ///< any length but zero; points to the side that is taken away
  std::optional<double> d;  ///< none: through the middle of the solid, as it reaches along the normal

  friend bool operator==(const SectionPlane&, const SectionPlane&) = default;
};

/// One cut of a section view: it takes away what lies beyond all of its planes; beyond one a half of space, beyond two
/// at right angles a quarter. Several cuts each take away their part.
///
/// The solid that is left is closed: where a plane goes through it there is a cut face, which shows the material of
/// what was cut there.
struct SectionCut {
  std::vector<SectionPlane> planes;

  friend bool operator==(const SectionCut&, const SectionCut&) = default;
};

}  // namespace tenon
