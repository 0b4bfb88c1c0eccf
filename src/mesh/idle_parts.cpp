#include "mesh/idle_parts.h"

#include <algorithm>
#include <numeric>
#include <optional>

#include "primitive/mesh_bvh.h"
#include "primitive/mesh_crossings.h"
#include "primitive/mesh_edges.h"

namespace tenon {

namespace {

/// The parts of a mesh, each by its lowest triangle.
class PartFinder {
 public:
  explicit PartFinder(const TriangleMesh& mesh) : parent_(mesh.triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    const std::vector<EdgeUse> uses = sorted_edge_uses(mesh.triangles);
    for (std::size_t i = 1; i < uses.size(); ++i) {
      if (uses[i].ends() != uses[i - 1].ends()) continue;
      join(uses[i].triangle, uses[i - 1].triangle);
      has_crowded_edges_ |= i > 1 && uses[i].ends() == uses[i - 2].ends();
    }
  }
  /// Whether an edge has more than two triangles.
  bool has_crowded_edges() const { return has_crowded_edges_; }
  std::uint32_t lowest_of(std::uint32_t triangle) {
    while (parent_[triangle] != triangle) {
      parent_[triangle] = parent_[parent_[triangle]];
      triangle = parent_[triangle];
    }
    return triangle;
  }

 private:
  void join(std::uint32_t a, std::uint32_t b) {
    a = lowest_of(a);
    b = lowest_of(b);
    parent_[std::max(a, b)] = std::min(a, b);
  }
  std::vector<std::uint32_t> parent_;
  bool has_crowded_edges_ = false;
};

Box3 bounds_of(const TriangleMesh& mesh) {
  Box3 bounds;
  for (const Vec3& v : mesh.vertices) bounds = hull(bounds, v);
  return bounds;
}

class Windings {
 public:
  explicit Windings(const TriangleMesh& mesh) : mesh_(mesh), bounds_(bounds_of(mesh)), bvh_(mesh) {}

  // How often the mesh winds around what lies before a triangle, on the side that it faces: by a line that enters
  // there. Nothing where another triangle lies so near that it cannot be told which of both comes first.
  std::optional<int> before(std::uint32_t triangle) const {
    const auto [a, b, c] = mesh_.corners(triangle);
    const Vec3 n = cross(b - a, c - a);
    if (!(max_component(abs(n)) > 0)) return std::nullopt;
    LocalRay ray;
    // Off the middle, where edges of other parts like to lie.
    ray.origin = 0.41 * a + 0.26 * b + 0.33 * c;
    ray.direction = -n;
    const MeshLine line(ray, bounds_);
    MeshCandidate target;
    if (!find_candidate(line, mesh_, triangle, target) || !target.is_hit || target.sense != -1) return std::nullopt;
    int winding = 0;
    bool is_clear = true;
    bvh_.walk(line, {}, [&](std::uint32_t other) {
      MeshCandidate met;
      if (other == triangle || !find_candidate(line, mesh_, other, met) || !met.is_hit) return;
      if (met.hi < target.lo) {
        winding -= met.sense;
      } else if (met.lo <= target.hi) {
        is_clear = false;
      }
    });
    if (!is_clear) return std::nullopt;
    return winding;
  }

 private:
  const TriangleMesh& mesh_;
  Box3 bounds_;
  MeshBvh bvh_;
};

}  // namespace

IdleParts find_idle_parts(const TriangleMesh& mesh) {
  // A part's triangles that lie on others cannot tell; of a few one can.
  constexpr int most_tries = 16;
  struct Part {
    int tries = 0;
    std::optional<int> winding;
  };
  PartFinder parts(mesh);
  const auto count = static_cast<std::uint32_t>(mesh.triangles.size());
  IdleParts found;
  for (std::uint32_t t = 0; t < count; ++t) found.part_count += parts.lowest_of(t) == t;
  // Around a single part is nothing, and it faces outward (build_mesh).
  found.winds_once = !parts.has_crowded_edges();
  if (found.part_count <= 1) return found;
  const Windings windings(mesh);
  std::vector<Part> known(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    Part& part = known[parts.lowest_of(t)];
    if (part.winding || part.tries >= most_tries) continue;
    ++part.tries;
    part.winding = windings.before(t);
    if (part.winding.value_or(0) == 0) continue;
    IdleParts::Parts& told = *part.winding < 0 ? found.inside_out : found.swallowed;
    if (told.count++ == 0) told.first = t;
  }
  for (std::uint32_t t = 0; t < count && found.winds_once; ++t) {
    found.winds_once = known[parts.lowest_of(t)].winding == 0;
  }
  return found;
}

}  // namespace tenon
