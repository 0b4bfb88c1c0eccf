#include <algorithm>
#include <array>
#include <cmath>

#include "primitive/box_tests.h"
#include "primitive/mesh.h"

namespace tenon {

namespace {

/// What a triangle and a box have in common: a polygon, cut face by face of the box (Sutherland and Hodgman 1974).
class ClippedTriangle {
 public:
  ClippedTriangle(const std::array<Vec3, 3>& corners, const LocalBox& box) {
    for (const Vec3& corner : corners) points_[count_++] = corner;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 n = cross(box.half_edges[(i + 1) % 3], box.half_edges[(i + 2) % 3]);
      const double reach = std::fabs(dot(n, box.half_edges[i]));
      cut(n, dot(n, box.center) + reach);
      cut(-n, reach - dot(n, box.center));
    }
  }
  /// Rounding has made more corners of it than a convex polygon can have.
  bool is_broken() const { return is_broken_; }
  const Vec3* begin() const { return points_.data(); }
  const Vec3* end() const { return points_.data() + count_; }

 private:
  // Each of six planes adds one corner at most, but for what rounds.
  using Points = std::array<Vec3, 12>;

  void cut(const Vec3& n, double d) {
    Points kept;
    std::size_t count = 0;
    for (std::size_t i = 0; i < count_; ++i) {
      if (count + 2 > kept.size()) {
        is_broken_ = true;
        break;
      }
      const Vec3 &p = points_[i], &q = points_[(i + 1) % count_];
      const double a = dot(n, p) - d, b = dot(n, q) - d;
      if (a <= 0) kept[count++] = p;
      if ((a < 0 && b > 0) || (a > 0 && b < 0)) kept[count++] = p + a / (a - b) * (q - p);
    }
    points_ = kept;
    count_ = count;
  }

  Points points_;
  std::size_t count_ = 0;
  bool is_broken_ = false;
};

LocalBox enlarged(const LocalBox& box, double factor) {
  LocalBox larger = box;
  for (Vec3& half_edge : larger.half_edges) half_edge = factor * half_edge;
  const Vec3 more = (factor - 1) * 0.5 * box.bounds.size();
  larger.bounds = {box.bounds.lower - more, box.bounds.upper + more};
  return larger;
}

// Greatest of n·p - d over some planes.
double highest(const std::vector<Plane>& planes, const Vec3& p) {
  double most = -Box3::inf;
  for (const Plane& plane : planes) most = std::max(most, dot(plane.normal, p) - plane.d);
  return most;
}

}  // namespace

// The planes of the triangles that the box meets. If each triangle lies below all planes, as far as it is in the box,
// then the triangles of one plane cover all that the others leave of it there: an edge within would belong to another
// triangle, whose plane it would lie in, and not below. So the solid has the boundary of what lies below the planes,
// and is that; or all but that, where each lies above all planes.
PlanarPart Mesh::planes_within(const LocalBox& box, std::vector<Plane>& planes) const {
  constexpr std::size_t most_triangles = 16, most_planes = 6;
  planes.clear();
  if (hull) return PlanarPart::unknown;
  // Whatever meets the part that is looked at is found, with what rounding makes of either.
  const LocalBox sought = enlarged(box, 1 + 0x1p-16), part = enlarged(box, 1 + 0x1p-20);
  struct Facet {
    std::uint32_t triangle;
    double area;
  };
  const FacedBox faced(sought);
  std::array<Facet, most_triangles> facets;
  std::size_t count = 0;
  const auto take = [&](std::uint32_t triangle) {
    const auto is_known = [triangle](const Facet& f) { return f.triangle == triangle; };
    if (!meets(faced, triangle)) return true;
    if (std::any_of(facets.begin(), facets.begin() + static_cast<std::ptrdiff_t>(count), is_known)) return true;
    if (count == most_triangles) return false;
    facets[count++] = {triangle, length(flat_normal(triangle))};
    return true;
  };
  if (!std::visit([&](const auto& structure) { return structure.walk(sought.bounds, take); }, index_->structure)) {
    return PlanarPart::unknown;
  }
  // Those that know their plane best come first.
  const auto end = facets.begin() + static_cast<std::ptrdiff_t>(count);
  std::sort(facets.begin(), end, [](const Facet& a, const Facet& b) {
    return a.area != b.area ? a.area > b.area : a.triangle < b.triangle;
  });

  // As in a wedge of a prism (wedge.cpp): well above what is rounded here, and far below what crossings are told apart
  // by.
  const Vec3 reach =
      max(max(abs(index_->bounds.lower), abs(index_->bounds.upper)), max(abs(box.bounds.lower), abs(box.bounds.upper)));
  const double slip = 0x1p-44 * length(reach);
  std::vector<ClippedTriangle> pieces;
  for (auto facet = facets.begin(); facet != end; ++facet) {
    const std::array<Vec3, 3> corners = mesh->corners(facet->triangle);
    const ClippedTriangle piece(corners, part);
    if (piece.is_broken()) return PlanarPart::unknown;
    if (piece.begin() == piece.end()) continue;
    pieces.push_back(piece);
    const Vec3 normal = 1 / facet->area * flat_normal(facet->triangle);
    if (!(facet->area > 0) || !std::isfinite(normal.x + normal.y + normal.z)) return PlanarPart::unknown;
    const auto lies_in = [&](const Plane& plane) {
      return dot(plane.normal, normal) > 0 && std::all_of(corners.begin(), corners.end(), [&](const Vec3& corner) {
               return std::fabs(dot(plane.normal, corner) - plane.d) <= slip;
             });
    };
    if (std::any_of(planes.begin(), planes.end(), lies_in)) continue;
    const Plane plane{normal, dot(normal, corners[0])};
    if (planes.size() == most_planes || !lies_in(plane)) return PlanarPart::unknown;
    planes.push_back(plane);
  }
  if (planes.empty()) return PlanarPart::unknown;

  const auto all_below = [&] {
    return std::all_of(pieces.begin(), pieces.end(), [&](const ClippedTriangle& piece) {
      return std::all_of(piece.begin(), piece.end(), [&](const Vec3& p) { return highest(planes, p) <= slip; });
    });
  };
  PlanarPart found = PlanarPart::below_all;
  if (!all_below()) {
    for (Plane& plane : planes) plane = {-plane.normal, -plane.d};
    if (!all_below()) return PlanarPart::unknown;
    found = PlanarPart::above_any;
  }
  // Whether the mesh means it so, a place below all planes tells, and one beyond each: where parts of it overlap, or
  // lie on one another, it may not. What of the box is beyond a plane is one part, and has the corner that lies
  // highest.
  const Region solid_below = found == PlanarPart::below_all ? Region::inside : Region::outside;
  const Region solid_above = found == PlanarPart::below_all ? Region::outside : Region::inside;
  const auto is_at = [&](const Vec3& p, Region region) { return classify({p, {}, {}, {p, p}}) == region; };
  Vec3 below = box.center;
  std::array<Vec3, 8> box_corners;
  for (int i = 0; i < 8; ++i) {
    const Vec3 corner = box.corner(i), halfway = 0.5 * (box.center + corner);
    for (const Vec3& p : {halfway, corner}) {
      if (highest(planes, p) < highest(planes, below)) below = p;
    }
    box_corners[static_cast<std::size_t>(i)] = corner;
  }
  std::array<bool, 8> is_known{};
  bool is_anything_above = false;
  for (const Plane& plane : planes) {
    const auto* const top = std::max_element(box_corners.begin(), box_corners.end(), [&](const Vec3& a, const Vec3& b) {
      return dot(plane.normal, a) < dot(plane.normal, b);
    });
    if (!(dot(plane.normal, *top) - plane.d > 2 * slip)) continue;
    is_anything_above = true;
    bool& known = is_known[static_cast<std::size_t>(top - box_corners.begin())];
    if (!known && !is_at(*top, solid_above)) return PlanarPart::unknown;
    known = true;
  }
  const bool is_meant = is_anything_above && highest(planes, below) < -2 * slip && is_at(below, solid_below);
  return is_meant ? found : PlanarPart::unknown;
}

}  // namespace tenon
