#pragma once

#include "primitive/mesh_bvh.h"
#include "primitive/ray_packet.h"
#include "tenon/math/box3.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// How large a mesh is, and its triangles.
struct MeshExtent {
  Box3 bounds;
  double facet = 0;  ///< the area of a triangle, on average
};

/// Mesh::next_crossing() for rays that go much the same way: the triangles that any of them may cross are found once
/// for all (Wald et al. 2007, "Ray tracing deformable scenes using dynamic bounding volume hierarchies": a packet
/// stands for its rays), and each is held against as many rays at once as a vector has doubles.
///
/// Of rays that go another way than the first, that are not certain of what they meet, or that have too many triangles
/// between them, it says nothing.
/// @param mesh   one that winds once
/// @param found  of the rays that nothing is said of, as it was
void find_next_crossings(const TriangleMesh& mesh, const MeshBvh& bvh, const MeshExtent& extent,
                         const LocalRayPacket& rays, PacketCrossings& found);

}  // namespace tenon
