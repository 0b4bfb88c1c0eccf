#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/input_file.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// What a mesh file or a scene says: faces of any number of corners, not yet checked. Every reader promises that
/// corners name points that are there, that points are finite, and that no file makes it larger than a few times the
/// file.
struct PolygonSoup {
  static constexpr std::uint32_t no_normal = ~std::uint32_t{0};

  std::vector<Vec3> points;
  std::vector<std::uint32_t> corners;         ///< into `points`, face after face
  std::vector<std::uint32_t> ends;            ///< of each face, into `corners`
  std::vector<Vec3> normals;                  ///< for shading
  std::vector<std::uint32_t> corner_normals;  ///< into `normals`, one a corner; empty when the file has none

  std::size_t face_count() const { return ends.size(); }
  std::size_t begin_of(std::size_t face) const { return face == 0 ? 0 : ends[face - 1]; }
  std::span<const std::uint32_t> face(std::size_t i) const {
    return {corners.data() + begin_of(i), ends[i] - begin_of(i)};
  }

  void add_face(std::span<const std::uint32_t> face_corners) {
    corners.insert(corners.end(), face_corners.begin(), face_corners.end());
    ends.push_back(static_cast<std::uint32_t>(corners.size()));
  }
};

using MeshFile = InputFile;

/// Each reads one format. Errors name the line and the column where there are lines, and the byte where there are none.
Result<PolygonSoup> read_stl(const MeshFile& file);
Result<PolygonSoup> read_obj(const MeshFile& file);
Result<PolygonSoup> read_off(const MeshFile& file);
Result<PolygonSoup> read_ply(const MeshFile& file);
Result<PolygonSoup> read_3mf(const MeshFile& file);
Result<PolygonSoup> read_amf(const MeshFile& file);

}  // namespace tenon
