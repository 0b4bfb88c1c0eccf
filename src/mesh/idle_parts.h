#pragma once

#include <cstddef>
#include <cstdint>

#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// Parts of a closed mesh that add nothing to its solid: what the mesh winds around at least once.
struct IdleParts {
  struct Parts {
    std::size_t count = 0;
    std::uint32_t first = 0;  ///< the lowest triangle of any
  };
  std::size_t part_count = 0;  ///< of the whole mesh
  Parts inside_out;  ///< facing inward where no other part is around: the mesh winds around them less than never
  Parts swallowed;   ///< facing outward within another part
  /// Known that the mesh does not wind around what lies before any part, and that no edge has more than two triangles:
  /// then, where it does not pass through itself, it winds around each place once or not at all. For all triangles of a
  /// part hang together by such edges, so it winds as often around what lies before them all.
  bool winds_once = false;
};

/// Holds one triangle of each part (what hangs together by edges) against how often the mesh winds around the place
/// before it. A part that passes through others may be told by either of its places.
IdleParts find_idle_parts(const TriangleMesh& mesh);

}  // namespace tenon
