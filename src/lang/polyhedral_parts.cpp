#include "lang/polyhedral_parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <tuple>

#include "csg/tolerance.h"
#include "lang/polyhedron_facets.h"
#include "mesh/convex_partition.h"
#include "plane/outline_figures.h"
#include "plane/shape.h"

namespace tenon::lang {

namespace {

using Parts = std::vector<ConvexCell>;

// More than a scene can mean.
constexpr std::size_t most_parts = 4096;

double same_place(const Parts& parts) {
  double largest = 0;
  for (const ConvexCell& part : parts) largest = std::max(largest, part.largest_coordinate());
  return Tolerance::relative * largest;
}

std::optional<Parts> parts_around(const std::vector<Vec3>& points) {
  auto cell = ConvexCell::around(points);
  return cell ? Parts{std::move(*cell)} : Parts{};
}

std::optional<Parts> parts_of_facets(const PolyhedronFacets& facets) {
  const auto whole = ConvexCell::around(facets.points);
  if (!whole) return Parts{};
  std::vector<FlatPolygon> walls;
  for (const auto& corners : facets.triangles) {
    auto wall = FlatPolygon::of({facets.points[corners[0]], facets.points[corners[1]], facets.points[corners[2]]});
    if (wall) walls.push_back(std::move(*wall));
  }
  const auto is_inside = [&](const Vec3& p) { return winding_around(p, facets.points, facets.triangles) > 0.5; };
  return convex_partition(*whole, std::move(walls), is_inside, same_place({*whole}), most_parts);
}

/// An outline of straight walls, swept along z and scaled on its way.
class StraightSweep {
 public:
  explicit StraightSweep(const UnionLeaf& leaf)
      : map_(leaf.map), outline_(resolve(Shape::of(std::get<Outline>(leaf.values[0])))), edges_(outline_) {
    const double height = std::get<double>(leaf.values[1]);
    low_ = std::get<bool>(leaf.values[2]) ? -height / 2 : 0;
    high_ = low_ + height;
    scale_ = std::get<double>(leaf.values[3]);
  }

  std::optional<Parts> parts() const {
    std::vector<Vec3> points;
    std::vector<FlatPolygon> walls;
    for (const OutlineEdge& edge : edges_.edges()) {
      const Vec3 a = at(edge.from, 0), b = at(edge.to, 0), c = at(edge.to, 1), d = at(edge.from, 1);
      points.insert(points.end(), {a, d});
      if (auto wall = FlatPolygon::of({a, b, c, d})) walls.push_back(std::move(*wall));
    }
    const auto whole = ConvexCell::around(points);
    const auto to_frame = map_.inverse();
    if (!whole || !to_frame) return Parts{};
    const auto is_inside = [&](const Vec3& p) {
      const Vec3 q = to_frame->point(p);
      const double scale = scale_at((q.z - low_) / (high_ - low_));
      return edges_.contains({q.x / scale, q.y / scale});
    };
    return convex_partition(*whole, std::move(walls), is_inside, same_place({*whole}), most_parts);
  }

 private:
  double scale_at(double share) const { return 1 + share * (scale_ - 1); }
  Vec3 at(const Vec2& p, double share) const {
    const double scale = scale_at(share);
    return map_.point({scale * p.x, scale * p.y, low_ + share * (high_ - low_)});
  }

  const Affine3 map_;
  const Outline outline_;
  const OutlineEdges edges_;
  double low_ = 0, high_ = 0, scale_ = 1;
};

/// What operations make of parts.
class PartOperations {
 public:
  explicit PartOperations(const SceneGraph& graph) : graph_(graph) {}

  std::optional<Parts> parts(SceneNodeId id, const Affine3& map) const {
    const SceneNode& node = graph_[id];
    if (const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content)) {
      return polyhedral_parts(
          {graph_.primitives.kind(leaf->primitive).name, graph_.primitives.values(leaf->primitive), map});
    }
    const auto* transform = std::get_if<Transform>(&node.content);
    const auto* set_operation = std::get_if<SetOperation>(&node.content);
    const SetOperation operation = set_operation ? *set_operation : SetOperation::union_;
    if (operation == SetOperation::complement) return std::nullopt;
    std::optional<Parts> result;
    for (const SceneNodeId child : node.children) {
      auto next = parts(child, transform ? map * transform->parent_from_child : map);
      if (!next) return std::nullopt;
      result = result ? combined(operation, std::move(*result), *next) : std::move(next);
      if (result->size() > most_parts) return std::nullopt;
    }
    return result ? std::move(result) : Parts{};
  }

 private:
  static Parts combined(SetOperation operation, Parts a, const Parts& b) {
    const double same = std::max(same_place(a), same_place(b));
    if (operation == SetOperation::union_) {
      a.insert(a.end(), b.begin(), b.end());
      return a;
    }
    if (operation == SetOperation::intersection) {
      Parts result;
      for (const ConvexCell& p : a) {
        for (const ConvexCell& q : b) {
          if (auto common = intersection(p, q, same)) result.push_back(std::move(*common));
        }
        if (result.size() > most_parts) break;
      }
      return result;
    }
    for (const ConvexCell& q : b) {
      Parts rest;
      for (const ConvexCell& p : a) {
        for (ConvexCell& part : difference(p, q, same)) rest.push_back(std::move(part));
      }
      a = std::move(rest);
      if (a.size() > most_parts) break;
    }
    return a;
  }

  const SceneGraph& graph_;
};

}  // namespace

std::optional<std::vector<ConvexCell>> polyhedral_parts(const UnionLeaf& leaf) {
  const bool is_straight = leaf.kind == "prism" && !has_arcs(std::get<Outline>(leaf.values[0]));
  if (is_straight && !is_convex(leaf)) return StraightSweep(leaf).parts();
  const bool has_points = is_straight || leaf.kind == "cube" || leaf.kind == "convex_polyhedron" || leaf.kind == "mesh";
  if (!has_points) return std::nullopt;
  if (is_convex(leaf)) {
    std::vector<Vec3> points;
    const auto spanning = spanning_balls(leaf);
    for (const Ball& ball : spanning->balls) points.push_back(ball.center);
    return parts_around(points);
  }
  const auto facets = polyhedron_facets(leaf);
  return facets ? parts_of_facets(*facets) : std::nullopt;
}

std::optional<std::vector<ConvexCell>> polyhedral_parts(const SceneGraph& graph, SceneNodeId id, const Affine3& map) {
  return PartOperations(graph).parts(id, map);
}

UnionLeaf leaf_of(const ConvexCell& cell) {
  auto mesh = std::make_shared<TriangleMesh>();
  std::map<std::tuple<double, double, double>, std::uint32_t> numbers;
  for (const FlatPolygon& face : cell.faces()) {
    std::vector<std::uint32_t> corners;
    for (const Vec3& p : face.corners) {
      const auto [place, is_new] = numbers.try_emplace({p.x, p.y, p.z}, static_cast<std::uint32_t>(numbers.size()));
      if (is_new) mesh->vertices.push_back(p);
      corners.push_back(place->second);
    }
    for (std::size_t i = 2; i < corners.size(); ++i)
      mesh->triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  return {"mesh", {SharedMesh(std::move(mesh)), false}, {}};
}

}  // namespace tenon::lang
