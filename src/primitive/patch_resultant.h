#pragma once

#include "math/root_isolation.h"
#include "primitive/bezier_patch.h"

namespace tenon {

/// Where in u two bicubic functions over the unit square may both be zero: outside of the pieces that are not `empty`
/// they certainly are not, for whatever v. By Bézout's form of the resultant, of degree 18 (Kajiya, "Ray tracing
/// parametric patches", SIGGRAPH 1982).
///
/// @param error   bounds that of every value of either net
/// @param pieces  of u in [0, 1]; overwritten
void isolate_by_resultant(const BezierNet<double>& f, const BezierNet<double>& g, double error, RootPieces& pieces);

}  // namespace tenon
