#pragma once

#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "mesh/height_map.h"

namespace tenon::fuzz {

/// Reads a height map. Ends the program where a message is missing, or a face names a point that is not there or not
/// finite.
inline void try_heights(const MeshFile& file) {
  const auto require = [](bool holds, const char* what) {
    if (holds) return;
    std::fputs(what, stderr);
    std::abort();
  };
  for (const bool invert : {false, true}) {
    const Result<PolygonSoup> soup = read_height_map(file, {invert, invert});
    if (!soup) {
      require(!soup.error().message.empty() && soup.error().where.known(), "an error says nothing\n");
      continue;
    }
    for (const Vec3& p : soup->points) require(std::isfinite(p.x + p.y + p.z), "a point is not finite\n");
    for (const std::uint32_t corner : soup->corners) require(corner < soup->points.size(), "a point is not there\n");
  }
}

}  // namespace tenon::fuzz
