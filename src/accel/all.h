#pragma once

#include <memory>

#include "accel/options.h"
#include "csg/csg_tree.h"
#include "tenon/accel/accelerator.h"

/// The closed list of structures: X(function, "command-line name", "variants", "what it is").
///
/// A line here gives a structure its name on the command line, its tests, its benchmark row and its row in the docs.
/// `variants` are the option strings, beside the defaults, that the tests run too: "key=value,key=value;key=value".
// clang-format off
#define TENON_ACCELERATORS(X) \
  X(none, "none", "", "every primitive, every ray: the oracle (Roth 1982)") \
  X(nbvh, "nbvh", "clip=off;order=near", "boxes on the CSG tree itself, clipped by the operators (Zajicek 2012)") \
  X(median_bvh, "median-bvh", \
    "volume=sphere;volume=ellipsoid,leaf=3;volume=slabs,filter=on;volume=slabs,normals=13,leaf=4;filter=on", \
    "median cut over slabs; volumes: box, sphere, ellipsoid, slabs (Bouatouch's course)") \
  X(goldsmith_bvh, "goldsmith-bvh", "order=given", \
    "objects inserted one by one where the surface area grows least (Goldsmith & Salmon 1987)")
// clang-format on

namespace tenon {

/// What a structure is built from.
struct BuildInput {
  const CsgTree& tree;
  const ScreenView* view = nullptr;  ///< none: rays may come from anywhere
};

/// `build_NAME(input, options)` for each structure: takes its options, then builds. Reports options it does not know.
#define TENON_DECLARE(function, name, variants, doc) \
  Result<std::unique_ptr<Accelerator>> build_##function(const BuildInput& input, AcceleratorOptions& options);
TENON_ACCELERATORS(TENON_DECLARE)
#undef TENON_DECLARE

}  // namespace tenon
