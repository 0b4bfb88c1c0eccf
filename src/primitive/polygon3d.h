#pragma once

#include <array>
#include <string>
#include <string_view>
#include <tuple>

#include "math/bounded_root.h"
#include "primitive/concept.h"

namespace tenon {

/// A planar polygon, concave or with holes: a surface without inside (course, "Polygon").
///
/// A point of its plane is inside when a way from it to infinity crosses the loops an odd number of times; so loops may
/// be holes, and may be given in any sense. Points nearer to an edge than the ray is known count as inside, so that
/// polygons that share an edge leave no gap.
class Polygon3d {
 public:
  static constexpr std::array<std::string_view, 2> methods{"snyder", "marchal"};

  PointLists points{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  PointLists normals;
  Choice method{0, methods};

  static constexpr std::string_view name = "polygon3d", scad_name = "polygon3d";
  static constexpr std::string_view doc = "A planar polygon in space, a surface without inside.";
  static constexpr bool bounded = true;
  static constexpr bool hull = true;
  static constexpr double relative_cost = 2;
  static constexpr auto fields() {
    return std::tuple{
        Field{"points", Unit::length, &Polygon3d::points, "closed loops of corners [x, y, z] in one plane"},
        Field{"normals", Unit::none, &Polygon3d::normals, "one for each corner, to shade by; [] for the plane's"},
        Field{"method", Unit::none, &Polygon3d::method, "of the inside test and between normals: snyder or marchal"}};
  }

  void prepare();
  std::string check() const;

  double support(const Vec3& n) const;
  /// One crossing at most, with face 0.
  void spans(const LocalRay& ray, Spans& out) const;
  Region classify(const LocalBox& box) const;
  /// Between the corners' normals, where there are any.
  Vec3 normal(const Vec3& point, std::uint32_t face) const;

 private:
  struct Edge {
    Vec3 from, to;
    Vec3 from_normal, to_normal;
  };
  struct Found {
    bool inside = false;
    Vec3 normal;
  };

  Found find(const Vec3& point) const;
  Found find_by_snyder(const Vec3& point) const;
  Found find_by_marchal(const Vec3& point) const;
  /// The edge that the point is nearest to, and how near.
  const Edge& nearest_edge(const Vec3& point, double& distance, double& along) const;
  /// Of the plane's coordinates, twice the area between a and b as seen from the origin.
  double area(const Vec3& a, const Vec3& b) const { return cross(a, b)[axis_]; }

  std::vector<Edge> edges_;            // loop by loop
  std::vector<std::size_t> begin_of_;  // the first edge of each loop, and the end
  Plane plane_;
  int axis_ = 2;          // the largest component of the plane's normal (Snyder's i0)
  double deviation_ = 0;  // of the corners from the plane
};

}  // namespace tenon
