#include "lang/leaf_slice.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "lang/polyhedron_facets.h"
#include "lang/sweep_slice.h"
#include "lang/turned_slice.h"
#include "plane/arc_corners.h"
#include "plane/mapped_outline.h"

namespace tenon::lang {

namespace {

/// The loops in which a polyhedron crosses the plane z = 0. A corner in the plane counts as below it, so that each
/// triangle crosses in two edges or in none, and loops close.
class Slice {
 public:
  explicit Slice(const PolyhedronFacets& facets) : points_(facets.points) {
    for (const auto& corners : facets.triangles) {
      Edge enters{}, leaves{};
      bool crosses = false;
      for (std::size_t i = 0; i < 3; ++i) {
        const std::uint32_t a = corners[i], b = corners[(i + 1) % 3];
        if (is_above(a) == is_above(b)) continue;
        crosses = true;
        (is_above(b) ? enters : leaves) = std::minmax(a, b);
      }
      // The inside lies to the left as one goes from where the triangle's rim leaves the upper side.
      if (crosses) next_[leaves].push_back(enters);
    }
  }

  Outline outline() {
    Outline outline;
    while (!next_.empty()) {
      auto& loop = outline.loops.emplace_back();
      const Edge first = next_.begin()->first;
      Edge at = first;
      do {
        const Vec2 p = crossing(at);
        loop.push_back({p.x, p.y, 0});
        const auto found = next_.find(at);
        if (found == next_.end()) break;
        at = found->second.back();
        found->second.pop_back();
        if (found->second.empty()) next_.erase(found);
      } while (at != first);
    }
    std::erase_if(outline.loops, [](const auto& loop) { return loop.size() < 3; });
    return outline;
  }

 private:
  using Edge = std::pair<std::uint32_t, std::uint32_t>;

  bool is_above(std::uint32_t i) const { return points_[i].z > 0; }

  Vec2 crossing(const Edge& edge) const {
    const Vec3 &a = points_[edge.first], &b = points_[edge.second];
    const double t = a.z / (a.z - b.z);
    return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
  }

  const std::vector<Vec3>& points_;
  std::map<Edge, std::vector<Edge>> next_;
};

// The unit circle's image in which a sphere crosses the plane; no loops where it does not.
Outline slice_of_sphere(double r, const Affine3& map) {
  const auto inverse = map.inverse();
  if (!inverse) return {};
  // |origin + x u + y v|² <= r², completed to squares.
  const Vec3 u = inverse->column(0), v = inverse->column(1), origin = inverse->translation();
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), determinant = uu * vv - uv * uv;
  const double x = (uv * dot(v, origin) - vv * dot(u, origin)) / determinant;
  const double y = (uv * dot(u, origin) - uu * dot(v, origin)) / determinant;
  const Vec3 nearest = origin + x * u + y * v;
  const double square = (r - length(nearest)) * (r + length(nearest));
  if (!(square > 0)) return {};
  // With the root of the form in triangles, the ellipse is the unit circle's image.
  const double a = std::sqrt(uu), b = uv / a, c = std::sqrt(determinant) / a, radius = std::sqrt(square);
  const Affine3 of_circle{{{{radius / a, -radius * b / (a * c), 0, x}, {0, radius / c, 0, y}, {0, 0, 1, 0}}}};
  return mapped({{full_circle({{0, 0}, 1}, 1)}}, of_circle);
}

}  // namespace

std::optional<Shape> slice_of_leaf(const UnionLeaf& leaf) {
  if (leaf.kind == "sphere") return Shape::of(slice_of_sphere(std::get<double>(leaf.values[0]), leaf.map));
  if (const auto extrusion = extrusion_of(leaf)) {
    if (const auto aligned = aligned_extrusion(*extrusion, leaf.map)) {
      const bool meets = aligned->low <= 0 && aligned->high > 0;
      return meets ? Shape::of(aligned->outline) : Shape{};
    }
  }
  if (const auto facets = polyhedron_facets(leaf)) return Shape::of(resolve_winding(Slice(*facets).outline()));
  if (auto slice = slice_of_turned(leaf)) return slice;
  return slice_of_sweep(leaf);
}

}  // namespace tenon::lang
