#pragma once

#include <string>
#include <variant>
#include <vector>

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// Why points and faces make no convex polyhedron.
struct BadPolyhedron {
  std::string message;
  bool empty = false;  ///< it is only without volume
  bool is_general =
      false;  ///< not convex, of many planes, or with a bent face: for a mesh, which says whether it is closed
};

/// A polyhedron of more is a mesh: the time of a ray grows with the number of planes, of a mesh's with its logarithm.
inline constexpr std::size_t most_planes = 32;

/// The planes of a convex polyhedron given by its corners and faces. Faces may be oriented either way.
std::variant<std::vector<Plane>, BadPolyhedron> planes_of(const std::vector<Vec3>& points,
                                                          const std::vector<std::vector<std::size_t>>& faces);

/// The solid that faces enclose: by planes where it is convex and has few, else by a mesh. Fails where they enclose
/// none; warns, and makes nothing, where it has no volume.
/// @param at  of what asks for it
Solid polyhedron_solid(ModuleEvaluator& evaluator, const std::vector<Vec3>& points,
                       const std::vector<std::vector<std::size_t>>& faces, Place at);

}  // namespace tenon::lang
