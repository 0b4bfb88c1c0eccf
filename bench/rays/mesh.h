#pragma once

#include <string>

#include "rays/bench_scene.h"
#include "rays/embree_tracer.h"

namespace tenon::bench {

/// A mesh of a scene's solid, and what it took.
struct MadeMesh {
  TriangleMesh mesh;
  double cpu_seconds = 0;  ///< the Booleans; without starting the program that makes them and without files
};

/// The tree of a scene as bench/mesh/make_mesh.mjs reads it, with the error each leaf's mesh may have (chord_error at
/// the nearest depth of the leaf's bounds, in the leaf's frame).
std::string solid_json(const BenchScene& scene, int columns);

/// The largest chord_error of a leaf, in the world: no point of the mesh lies farther from the solid's surface.
double largest_error(const BenchScene& scene, int columns);

/// Makes the mesh with Manifold, in a process of its own.
/// @param folder  for the files that pass between the two
Result<MadeMesh> make_mesh(const BenchScene& scene, int columns, const std::string& folder);

}  // namespace tenon::bench
