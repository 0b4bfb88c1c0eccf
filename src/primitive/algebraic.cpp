#include "primitive/algebraic.h"

#include <cmath>

#include "primitive/box_clip.h"
#include "primitive/check.h"

namespace tenon {

void Algebraic::prepare() {
  if (!check().empty()) return;
  solid_ = AlgebraicSolid(Polynomial3(terms), box, static_cast<RootIsolation>(isolation.index),
                          static_cast<RootRefinement>(refinement.index));
}

std::string Algebraic::check() const {
  if (std::string problem = check_box(name, box); !problem.empty()) return problem;
  bool varies = false;
  for (const PolynomialTerm& t : terms) {
    const std::string term = "term [" + std::to_string(t.i) + ", " + std::to_string(t.j) + ", " + std::to_string(t.k) +
                             ", " + shortest(t.a) + "] of algebraic ";
    if (t.i < 0 || t.j < 0 || t.k < 0) return term + "has a negative exponent";
    if (t.i + t.j + t.k > Polynomial3::most_degree) {
      return term + "is of degree " + std::to_string(t.i + t.j + t.k) + "; double tells roots apart up to degree " +
             std::to_string(Polynomial3::most_degree);
    }
    if (!std::isfinite(t.a)) return term + "is not finite";
    varies = varies || (t.a != 0 && t.i + t.j + t.k > 0);
  }
  if (!varies) return "algebraic with a polynomial that is constant bounds nothing";
  // Within these no intermediate result leaves the range of double.
  const double size = Polynomial3(terms).size(max(abs(box.lower), abs(box.upper)));
  if (!(size > 1e-200 && size < 1e200)) {
    return "algebraic with values of size " + shortest(size) + " is beyond what can be computed with; scale its terms";
  }
  return {};
}

double Algebraic::support(const Vec3& n) const {
  return box_support(box, n);
}

}  // namespace tenon
