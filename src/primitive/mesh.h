#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <variant>

#include "primitive/concept.h"
#include "primitive/faced_box.h"
#include "primitive/mesh_bvh.h"
#include "primitive/mesh_clear_cells.h"
#include "primitive/mesh_kd_tree.h"
#include "primitive/next_crossing.h"
#include "primitive/ray_packet.h"

namespace tenon {

/// A triangle mesh: the solid that a closed one encloses (Zajíček 2012, chapter 3), or the bare surface of any.
///
/// Where a closed mesh overlaps itself the solid is the union: what it winds around at least once.
class Mesh {
 public:
  SharedMesh mesh = unit_tetrahedron();
  bool hull = false;

  static constexpr std::string_view name = "mesh", scad_name = "polyhedron";
  static constexpr std::string_view doc = "The solid inside a closed mesh of triangles, or the surface of an open one.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 12;
  static constexpr auto fields() {
    return std::tuple{Field{"mesh", Unit::none, &Mesh::mesh, "vertices and triangles"},
                      Field{"hull", Unit::none, &Mesh::hull, "the surface alone, which has no inside"}};
  }

  void prepare();
  std::string check() const;

  double support(const Vec3& n) const;

  /// Every crossing of the line with the solid, whatever it grazes: which triangles the line meets is decided exactly
  /// (edge_sign), so each edge and each vertex is crossed once or not at all. Faces: the triangles, by index.
  void spans(const LocalRay& ray, Spans& out) const { spans_within(ray, {}, out); }
  /// The same, but for crossings beyond the window: an entrance at -inf, or an exit at +inf, may stand for all of them
  /// where the line is inside there.
  void spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const;
  NextCrossing next_crossing(const LocalRay& ray, const CrossingSearch& search) const;
  void next_crossings(const LocalRayPacket& rays, PacketCrossings& found) const;
  bool tells_packets() const;
  std::optional<Crossing> crossing_near(const LocalRay& ray, double t, double near, bool entering) const;
  /// Where no place away from all triangles is known, a window is no help. By trial on OpenSCAD's examples.
  double window_share() const { return index_->clear.bytes() == 0 ? 1 : 0.4; }
  /// A ray that starts on a face is asked for from there on.
  static constexpr bool tells_from_start = true;
  Region classify(const LocalBox& box) const;
  PlanarPart planes_within(const LocalBox& box, std::vector<Plane>& planes) const;
  /// Between the corners' normals where the mesh has them.
  std::uint32_t face_count() const { return static_cast<std::uint32_t>(mesh->triangles.size()); }
  Vec3 normal(const Vec3& point, std::uint32_t face) const;

 private:
  // What follows from the mesh; shared by all copies.
  struct Index {
    std::variant<MeshBvh, MeshKdTree> structure;
    Box3 bounds;
    double facet = 0;  // the area of a triangle, on average
    ClearCells clear;

    void walk(const MeshLine& line, const LineWindow& window, FunctionRef<void(std::uint32_t)> visit) const;
    void walk_forward(const MeshLine& line, const LineWindow& window, FunctionRef<double(std::uint32_t)> visit) const;
  };
  static SharedMesh unit_tetrahedron();
  Vec3 flat_normal(std::uint32_t face) const;
  bool meets(const FacedBox& box, std::uint32_t triangle) const;
  std::optional<bool> contains_middle(const LocalBox& box) const;

  std::shared_ptr<const Index> index_;
};

}  // namespace tenon
