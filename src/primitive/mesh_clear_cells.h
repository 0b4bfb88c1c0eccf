#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "primitive/mesh_line.h"
#include "tenon/base/function_ref.h"
#include "tenon/math/box3.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

/// The cells of a grid over a closed mesh that no triangle comes near: how often the mesh winds around such a place is
/// known. So a ray that starts on the surface need not be followed back to where its line enters the mesh.
class ClearCells {
 public:
  /// Calls visit(triangle) for each triangle that a line may cross.
  using Walk = FunctionRef<void(const MeshLine&, FunctionRef<void(std::uint32_t)>)>;

  ClearCells() = default;
  ClearCells(const TriangleMesh& mesh, const Box3& bounds, Walk walk);

  struct Place {
    double t;  ///< of the line, not yet scaled
    int winding;
  };
  /// A place on the line before t, or at it, that lies in a clear cell or outside of the mesh. No triangle's box
  /// reaches there, whatever the line is wrong by: so what the line meets of one lies before the place or behind it.
  /// @return nothing where none is near
  std::optional<Place> find_before(const MeshLine& line, double t) const { return find(line, t, -0.5 * edge_); }
  /// One behind t, or at it.
  std::optional<Place> find_behind(const MeshLine& line, double t) const { return find(line, t, 0.5 * edge_); }

  /// How often the mesh winds around a point, where that is known.
  std::optional<int> winding_at(const Vec3& point) const;

  std::size_t bytes() const { return windings_.size(); }

 private:
  using Index = std::array<int, 3>;
  static constexpr std::int8_t near_triangles = -128;

  int index_of(double coordinate, int axis) const;
  double middle_of(int index, int axis) const { return bounds_.lower[axis] + (index + 0.5) * edge_; }
  std::size_t place_of(const Index& cell) const {
    const auto place = [](int i) { return static_cast<std::size_t>(i); };
    return (place(cell[2]) * place(counts_[1]) + place(cell[1])) * place(counts_[0]) + place(cell[0]);
  }
  std::optional<Place> find(const MeshLine& line, double t, double step) const;
  bool mark(const TriangleMesh& mesh);
  void wind(const TriangleMesh& mesh, Walk walk);

  Box3 bounds_;
  Box3 beside_;  // what reaches out of it is beside the mesh
  double edge_ = 0, per_edge_ = 0, margin_ = 0;
  Index counts_{};
  std::vector<std::int8_t> windings_;
};

}  // namespace tenon
