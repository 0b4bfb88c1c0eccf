#pragma once

#include <cstdio>
#include <cstdlib>
#include <string>

#include "mesh/load_mesh.h"
#include "primitive/dispatch.h"

namespace tenon::fuzz {

/// Reads a mesh file, and where it makes a primitive sends rays through it. Ends the program where a message is missing
/// or the crossings of a solid do not alternate.
inline void try_mesh(const MeshFile& file) {
  const auto require = [](bool holds, const char* what) {
    if (holds) return;
    std::fputs(what, stderr);
    std::abort();
  };
  for (const bool hull : {false, true}) {
    Result<BuiltMesh> built = parse_mesh(file, hull);
    if (!built) {
      require(!built.error().message.empty() && built.error().where.known(), "an error says nothing\n");
      continue;
    }
    PrimitiveStore store;
    const Result<PrimitiveId> id =
        store.add(*PrimitiveStore::find_kind("mesh"),
                  std::vector<FieldValue>{std::make_shared<const TriangleMesh>(std::move(built->mesh)), hull});
    if (!id) {
      require(!id.error().message.empty(), "an error says nothing\n");
      continue;
    }
    const Box3 bounds = local_bounds(store, *id);
    for (int i = 0; i < 8; ++i) {
      LocalRay ray;
      ray.origin = {bounds.lower.x - 1, bounds.lower.y, bounds.center().z};
      const Vec3 corner{(i & 1) != 0 ? 1.0 : 0.5, (i & 2) != 0 ? 1.0 : 0.5, (i & 4) != 0 ? 1.0 : 0.5};
      ray.direction = bounds.lower + corner * bounds.size() - ray.origin;
      Spans crossings;
      spans(store, *id, ray, crossings);
      for (std::size_t k = 0; k < crossings.size() && !hull; ++k) {
        require(crossings[k].entering == (k % 2 == 0), "crossings do not alternate\n");
      }
      require(hull || crossings.size() % 2 == 0, "an odd number of crossings\n");
    }
  }
}

}  // namespace tenon::fuzz
