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
    "objects inserted one by one where the surface area grows least (Goldsmith & Salmon 1987)") \
  X(grid, "grid", "step=classic;resolution=3,mailbox=off", \
    "uniform 3D grid, classical and Amanatides's steps (Bouatouch's course)") \
  X(nonuniform_grid, "nonuniform-grid", "levels=3,mailbox=off", \
    "cells halved at their middle, with lists of objects (Bouatouch's course)") \
  X(space_tracing, "space-tracing", "levels=3,primitives=2;axes=eye", \
    "boxes halved at their middle, projected CSG trees, spatial index SI (RR-612, 1987)") \
  X(space_tracing_subgrids, "space-tracing-subgrids", "levels=1,sublevels=3;levels=0,sublevels=2,axes=eye", \
    "space tracing with sub-grids where boxes stay full (RR-612, section 6)") \
  X(bsp, "bsp", "split=macdonald-booth;leaf=1,depth=8;mailbox=off", \
    "binary space partition, descended from the root (Křivánek & Bubník)") \
  X(ropes, "ropes", "split=macdonald-booth;leaf=1,depth=8;mailbox=off", \
    "the same tree with ropes from each face, never back up (Křivánek & Bubník)") \
  X(rope_trees, "rope-trees", "split=macdonald-booth;leaf=1,depth=8", \
    "ropes replaced by trees pruned to the face (Křivánek & Bubník)") \
  X(okd, "okd", "split=msah;clip=off;clip=off,skip=off;traversal-cost=0", \
    "one kd-tree, and an operation tree with marks (Zajíček 2012)") \
  X(multi_kd, "multi-kd", "split=msah;traversal-cost=0;mailbox=off", \
    "a kd-tree for each operand of intersection and difference (Zajíček 2012)") \
  X(cells, "cells", "quality=fast;quality=high;depth=6;most-cells=40", \
    "space cut until the expression in a cell is a word of truth values")
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
