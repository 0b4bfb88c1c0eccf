#include "primitive/mesh_clear_cells.h"

#include <algorithm>
#include <cmath>

#include "primitive/mesh_crossings.h"

namespace tenon {

namespace {

// Some cells a triangle: then about as many are clear as not, and a few steps lead from the surface to one of them.
constexpr double cells_per_triangle = 4, most_cells = 1 << 21;
constexpr int most_along_axis = 256;
constexpr std::size_t fewest_triangles = 64;
constexpr int most_steps = 12;

Box3 box_of(const TriangleMesh& mesh, std::size_t triangle) {
  const auto [a, b, c] = mesh.corners(triangle);
  return {min(a, min(b, c)), max(a, max(b, c))};
}

}  // namespace

ClearCells::ClearCells(const TriangleMesh& mesh, const Box3& bounds, Walk walk) : bounds_(bounds) {
  if (mesh.triangles.size() < fewest_triangles) return;
  const Vec3 size = bounds.size();
  const double cells = std::min(cells_per_triangle * static_cast<double>(mesh.triangles.size()), most_cells);
  edge_ = std::max(std::cbrt(size.x / cells * size.y * size.z), max_component(size) / most_along_axis);
  per_edge_ = 1 / edge_;
  margin_ = edge_ / 16;
  beside_ = grown(bounds, 0.5 * margin_);
  // Far from the origin of its frame rounding would matter.
  if (!(edge_ > 0x1p-36 * max_component(max(abs(bounds.lower), abs(bounds.upper))))) return;
  for (int axis = 0; axis < 3; ++axis) {
    counts_[static_cast<std::size_t>(axis)] = 1 + static_cast<int>(size[axis] / edge_);
  }
  if (mark(mesh)) {
    wind(mesh, walk);
  } else {
    windings_.clear();
  }
}

int ClearCells::index_of(double coordinate, int axis) const {
  const double place = (coordinate - bounds_.lower[axis]) * per_edge_;
  return static_cast<int>(std::clamp(place, 0.0, counts_[static_cast<std::size_t>(axis)] - 1.0));
}

// Finds the cells that a triangle's box, grown by the margin, reaches into.
// @return false where the boxes are so large that none would be left
bool ClearCells::mark(const TriangleMesh& mesh) {
  windings_.assign(place_of({0, 0, counts_[2]}), 0);
  std::size_t allowance = 64 * mesh.triangles.size() + windings_.size();
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Box3 box = grown(box_of(mesh, t), margin_);
    Index from, to;
    std::size_t count = 1;
    for (int axis = 0; axis < 3; ++axis) {
      const auto i = static_cast<std::size_t>(axis);
      from[i] = index_of(box.lower[axis], axis);
      to[i] = index_of(box.upper[axis], axis);
      count *= static_cast<std::size_t>(to[i] - from[i] + 1);
    }
    if (count > allowance) return false;
    allowance -= count;
    for (int z = from[2]; z <= to[2]; ++z) {
      for (int y = from[1]; y <= to[1]; ++y) {
        const auto row = windings_.begin() + static_cast<std::ptrdiff_t>(place_of({0, y, z}));
        std::fill(row + from[0], row + to[0] + 1, near_triangles);
      }
    }
  }
  return true;
}

// By a line through the middles of each row of cells: what it crosses before a cell winds around it.
void ClearCells::wind(const TriangleMesh& mesh, Walk walk) {
  struct Turn {
    double behind;  // of the triangle's box
    int winding;
  };
  std::vector<Turn> turns;
  std::vector<std::uint32_t> met;
  for (int z = 0; z < counts_[2]; ++z) {
    for (int y = 0; y < counts_[1]; ++y) {
      const auto row = windings_.begin() + static_cast<std::ptrdiff_t>(place_of({0, y, z}));
      if (std::all_of(row, row + counts_[0], [](std::int8_t w) { return w == near_triangles; })) continue;
      LocalRay ray;
      ray.origin = {bounds_.lower.x, middle_of(y, 1), middle_of(z, 2)};
      ray.direction = {1, 0, 0};
      const MeshLine line(ray, bounds_);
      turns.clear();
      met.clear();
      walk(line, [&met](std::uint32_t triangle) { met.push_back(triangle); });
      // A kd-tree has a triangle in several leaves.
      std::sort(met.begin(), met.end());
      met.erase(std::unique(met.begin(), met.end()), met.end());
      for (const std::uint32_t triangle : met) {
        MeshCandidate c;
        if (!find_candidate(line, mesh, triangle, c) || !c.is_hit) continue;
        turns.push_back({box_of(mesh, triangle).upper.x, -c.sense});
      }
      std::sort(turns.begin(), turns.end(), [](const Turn& a, const Turn& b) { return a.behind < b.behind; });
      int winding = 0;
      std::size_t passed = 0;
      for (int x = 0; x < counts_[0]; ++x) {
        while (passed < turns.size() && turns[passed].behind < middle_of(x, 0)) winding += turns[passed++].winding;
        if (row[x] == near_triangles) continue;
        // A mesh that winds around a place a hundred times gets no clear cell there.
        row[x] = std::abs(winding) <= 100 ? static_cast<std::int8_t>(winding) : near_triangles;
      }
    }
  }
}

std::optional<ClearCells::Place> ClearCells::find(const MeshLine& line, double t, double step) const {
  // Triangles are a margin away from a clear cell. Half of it is left outside of the bounds, and of that the line and
  // its rounding may take half.
  if (windings_.empty() || !(max_component(line.growth) <= 0.25 * margin_) || !(std::fabs(t) <= line.farthest)) {
    return std::nullopt;
  }
  for (int i = 0; i < most_steps; ++i, t += step) {
    if (const auto winding = winding_at(line.origin + t * line.direction)) return Place{t, *winding};
  }
  return std::nullopt;
}

std::optional<int> ClearCells::winding_at(const Vec3& p) const {
  if (windings_.empty()) return std::nullopt;
  if (!beside_.contains(p)) return 0;
  const std::int8_t winding = windings_[place_of({index_of(p.x, 0), index_of(p.y, 1), index_of(p.z, 2)})];
  if (winding == near_triangles) return std::nullopt;
  return winding;
}

}  // namespace tenon
