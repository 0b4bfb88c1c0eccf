#include "mesh/self_intersection.h"

#include <algorithm>
#include <cmath>

#include "math/orientation.h"
#include "mesh/edge_fan.h"
#include "mesh/triangle_pair.h"
#include "primitive/mesh_bvh.h"
#include "primitive/mesh_edges.h"

namespace tenon {

namespace {

/// Edges by the triangles that use them.
class EdgeUses {
 public:
  explicit EdgeUses(const TriangleMesh& mesh) : uses_(sorted_edge_uses(mesh.triangles)) {}

  std::span<const EdgeUse> of(std::uint32_t a, std::uint32_t b) const {
    const std::pair edge = std::minmax(a, b);
    const auto [begin, end] = std::equal_range(uses_.begin(), uses_.end(), edge, Order{});
    return {begin, end};
  }
  /// Calls visit(uses) for each edge.
  template <class Visitor>
  void for_each(Visitor&& visit) const {
    for (std::size_t begin = 0, end; begin < uses_.size(); begin = end) {
      end = begin;
      while (end < uses_.size() && uses_[end].ends() == uses_[begin].ends()) ++end;
      visit(std::span(uses_).subspan(begin, end - begin));
    }
  }

 private:
  using Ends = std::pair<std::uint32_t, std::uint32_t>;
  struct Order {
    bool operator()(const EdgeUse& use, const Ends& ends) const { return use.ends() < ends; }
    bool operator()(const Ends& ends, const EdgeUse& use) const { return ends < use.ends(); }
  };
  std::vector<EdgeUse> uses_;
};

class Search {
 public:
  explicit Search(const TriangleMesh& mesh) : mesh_(mesh), edges_(mesh) {}

  SelfIntersection run() {
    look_at_crowded_edges();
    const MeshBvh bvh(mesh_);
    for (std::uint32_t t = 0; t < mesh_.triangles.size() && !is_full(); ++t) {
      const Box3 box = box_of(t);
      bvh.walk(box, [&](std::uint32_t other) {
        if (other <= t || !box.overlaps(box_of(other))) return true;
        if (const auto place = find_place(t, other)) note(t, other, *place);
        return !is_full();
      });
    }
    return found_;
  }

 private:
  Box3 box_of(std::uint32_t t) const {
    const auto [a, b, c] = mesh_.corners(t);
    return {min(a, min(b, c)), max(a, max(b, c))};
  }

  bool is_full() const { return found_.count >= SelfIntersection::most_counted; }

  void note(std::uint32_t t, std::uint32_t other, const Vec3& place) {
    if (found_.count == 0 || std::pair(t, other) < std::pair(found_.first, found_.second)) {
      found_.first = t;
      found_.second = other;
      found_.place = place;
    }
    ++found_.count;
  }

  // Edges that more than two triangles share: there alone can surfaces pass through one another in a shared edge.
  void look_at_crowded_edges() {
    edges_.for_each([&](std::span<const EdgeUse> uses) {
      if (uses.size() <= 2 || is_full()) return;
      const Segment edge{mesh_.vertices[uses[0].low], mesh_.vertices[uses[0].high]};
      EdgeFan fan(edge[0], edge[1]);
      add(uses, fan);
      if (fan.has_overlap()) note(uses[0].triangle, uses[1].triangle, 0.5 * (edge[0] + edge[1]));
    });
  }

  void add(std::span<const EdgeUse> uses, EdgeFan& fan) const {
    for (const EdgeUse& use : uses) {
      const TriangleMesh::Corners& corners = mesh_.triangles[use.triangle];
      const auto apex = std::find_if(corners.begin(), corners.end(),
                                     [&use](std::uint32_t v) { return v != use.low && v != use.high; });
      fan.add(mesh_.corners(use.triangle), mesh_.vertices[*apex]);
    }
  }

  // Where two triangles pass through one another, if they do.
  std::optional<Vec3> find_place(std::uint32_t i, std::uint32_t j) const {
    const Triangle a = mesh_.corners(i), b = mesh_.corners(j);
    const Sides of_b = sides(i, j);
    if (is_beside(of_b)) return std::nullopt;
    // What lies in a plane has its own there.
    const bool in_one_plane = of_b == Sides{};
    const Sides of_a = in_one_plane ? Sides{} : sides(j, i);
    if (is_beside(of_a)) return std::nullopt;
    if (pass_through(a, b, of_b, of_a)) return common_place(a, b);
    const auto view_a = FlatView::of(a), view_b = FlatView::of(b);
    // A triangle without area bounds nothing.
    if (!view_a || !view_b) return std::nullopt;
    if (in_one_plane && are_apart(a, b, *view_a)) return std::nullopt;
    if (in_one_plane && view_a->turn(a[0], a[1], a[2]) == view_a->turn(b[0], b[1], b[2]) && overlap(a, b, *view_a)) {
      return common_place(std::span<const Vec3>(b), a);
    }
    if (const auto place = pass_through_in_edge(j, of_b, i, *view_a)) return place;
    return pass_through_in_edge(i, of_a, j, *view_b);
  }

  // Where the corners of triangle j lie by triangle i. Those that both share lie in its plane.
  Sides sides(std::uint32_t i, std::uint32_t j) const {
    const TriangleMesh::Corners &plane = mesh_.triangles[i], &corners = mesh_.triangles[j];
    const Triangle p = mesh_.corners(i);
    Sides result{};
    for (std::size_t k = 0; k < 3; ++k) {
      if (std::find(plane.begin(), plane.end(), corners[k]) != plane.end()) continue;
      result[k] = -orientation(p[0], p[1], p[2], mesh_.vertices[corners[k]]);
    }
    return result;
  }

  // Whether a triangle touches a plane in a point at most, from one side.
  static bool is_beside(const Sides& sides) {
    const auto count = [&sides](int side) { return std::count(sides.begin(), sides.end(), side); };
    return count(0) <= 1 && (count(1) == 0 || count(-1) == 0);
  }

  // Triangle j has edges in the plane of i: whether surfaces pass through one another in one of them.
  std::optional<Vec3> pass_through_in_edge(std::uint32_t j, const Sides& of_j, std::uint32_t i,
                                           const FlatView& view) const {
    const TriangleMesh::Corners &ours = mesh_.triangles[j], &theirs = mesh_.triangles[i];
    const Triangle triangle = mesh_.corners(i);
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = ours[k], to = ours[(k + 1) % 3];
      if (of_j[k] != 0 || of_j[(k + 1) % 3] != 0) continue;
      const Segment edge{mesh_.vertices[from], mesh_.vertices[to]};
      if (runs_inside(edge, triangle, view)) {
        EdgeFan fan(edge[0], edge[1]);
        add(edges_.of(from, to), fan);
        fan.add_both_parts(triangle);
        if (fan.has_overlap()) return common_place(edge, triangle);
        continue;
      }
      for (std::size_t m = 0; m < 3; ++m) {
        const std::uint32_t begin = theirs[m], end = theirs[(m + 1) % 3];
        if (std::minmax(from, to) == std::minmax(begin, end)) continue;
        if (!run_along(edge, {mesh_.vertices[begin], mesh_.vertices[end]}, view)) continue;
        EdgeFan fan(edge[0], edge[1]);
        add(edges_.of(from, to), fan);
        add(edges_.of(begin, end), fan);
        if (fan.has_overlap()) return common_place(edge, triangle);
      }
    }
    return std::nullopt;
  }

  const TriangleMesh& mesh_;
  EdgeUses edges_;
  SelfIntersection found_;
};

}  // namespace

std::optional<SelfIntersection> find_self_intersection(const TriangleMesh& mesh) {
  // Products of three coordinates stay in range: scaling by a power of two changes nothing else.
  double largest = 0;
  for (const Vec3& v : mesh.vertices) largest = std::max(largest, max_component(abs(v)));
  if (!(largest > 0)) return std::nullopt;
  const int exponent = std::clamp(std::ilogb(largest), -1000, 1000);
  TriangleMesh unit;
  unit.triangles = mesh.triangles;
  for (const Vec3& v : mesh.vertices) unit.vertices.push_back(std::ldexp(1.0, -exponent) * v);
  SelfIntersection found = Search(unit).run();
  if (found.count == 0) return std::nullopt;
  found.place *= std::ldexp(1.0, exponent);
  return found;
}

}  // namespace tenon
