#pragma once

#include <array>
#include <vector>

#include "primitive/mesh_line.h"
#include "tenon/primitive/crossing.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// A triangle that the exact line may cross.
struct MeshCandidate {
  std::uint32_t triangle = 0;
  bool is_hit = false;      ///< the line as it is given crosses it
  bool is_certain = false;  ///< so does every line within the errors
  /// Of the edges opposite to each corner: the exact line may pass on either side.
  std::array<bool, 3> is_doubtful{};
  int sense = 0;          ///< -1: the line enters the solid there, 1: it leaves; 0: nobody knows
  double t = 0;           ///< of the line, not yet scaled
  double lo = 0, hi = 0;  ///< contains the exact crossing, if there is one
};

/// Whether the exact line may cross a triangle of the mesh, and where.
/// @return false when it certainly does not
bool find_candidate(const MeshLine& line, const TriangleMesh& mesh, std::uint32_t triangle, MeshCandidate& out);

/// Makes the crossings of a solid of what the line meets.
///
/// Candidates that share an edge in doubt stand for one another: where the computed line crosses one of them,
/// the exact line may cross another that faces the same way, so the interval of that crossing is widened to contain it.
/// Where the line as computed crosses none of them but the exact line may enter and leave, both ends of such a chord
/// are reported at one place (emit_chord says why).
///
/// @param winding_before  how often the mesh winds around the line before the first candidate; where it does, an
///                        entrance at -inf comes first
/// @param winding_behind  and behind the last one; where it does, an exit at +inf comes last
/// @param on_face         the triangle the ray starts on, or -1
void emit_solid(const TriangleMesh& mesh, std::vector<MeshCandidate>& candidates, double scale, int winding_before,
                int winding_behind, int on_face, Spans& out);

/// Reports the crossings of a surface without inside.
void emit_surface(std::vector<MeshCandidate>& candidates, double scale, int on_face, Spans& out);

}  // namespace tenon
