#pragma once

#include "csg/classifier.h"
#include "csg/csg_tree.h"
#include "tenon/math/ray.h"

namespace tenon {

/// What a run of the classifier means in the world: point, normal, material.
///
/// The material is that of the leaf that shows. A cut face, where the ray crosses the leaf and the solid in opposite
/// senses, shows the leaf's material only if it was given one; else that of the leaf that owns the solid's side. From a
/// transparent medium into an opaque one the material is the opaque solid's.
Hit make_hit(const CsgTree& tree, const Ray& ray, const Run& run);

}  // namespace tenon
