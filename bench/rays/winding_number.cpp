#include "rays/winding_number.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace tenon::bench {

namespace {

// Van Oosterom & Strackee, "The Solid Angle of a Plane Triangle", 1983.
double solid_angle(const std::array<Vec3, 3>& triangle, const Vec3& p) {
  const Vec3 a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  const double la = length(a), lb = length(b), lc = length(c);
  return 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

double winding(const std::vector<std::array<Vec3, 3>>& triangles, const Vec3& p) {
  double angle = 0;
  for (const auto& triangle : triangles) angle += solid_angle(triangle, p);
  return angle / (4 * std::numbers::pi);
}

}  // namespace

WindingNumber::WindingNumber(const tenon::TriangleMesh& mesh) {
  std::vector<std::uint32_t> order(mesh.triangles.size());
  std::iota(order.begin(), order.end(), 0u);
  if (!order.empty()) build(mesh, order, 0, order.size());
}

std::size_t WindingNumber::build(const tenon::TriangleMesh& mesh, std::vector<std::uint32_t>& order, std::size_t begin,
                                 std::size_t end) {
  constexpr std::size_t leaf_size = 16;
  const std::size_t index = nodes_.size();
  nodes_.emplace_back();
  Node node;
  node.count = end - begin;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (std::size_t i = begin; i < end; ++i) {
    const auto& corners = mesh.triangles[order[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = corners[k], b = corners[(k + 1) % 3];
      node.box = hull(node.box, mesh.vertices[a]);
      edges[{std::min(a, b), std::max(a, b)}] += a < b ? 1 : -1;
    }
    if (end - begin <= leaf_size) node.triangles.push_back(mesh.corners(order[i]));
  }
  const Vec3 apex = mesh.vertices[mesh.triangles[order[begin]][0]];
  for (const auto& [edge, uses] : edges) {
    const Vec3 a = mesh.vertices[edge.first], b = mesh.vertices[edge.second];
    for (int i = 0; i < std::abs(uses); ++i) node.fan.push_back(uses > 0 ? Triangle{apex, a, b} : Triangle{apex, b, a});
  }
  if (end - begin > leaf_size) {
    const Vec3 size = node.box.size();
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto at = order.begin();
    const std::size_t middle = begin + (end - begin) / 2;
    const auto key = [&](std::uint32_t t) {
      const auto [a, b, c] = mesh.corners(t);
      return a[axis] + b[axis] + c[axis];
    };
    std::nth_element(at + static_cast<std::ptrdiff_t>(begin), at + static_cast<std::ptrdiff_t>(middle),
                     at + static_cast<std::ptrdiff_t>(end),
                     [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
    node.children[0] = build(mesh, order, begin, middle);
    node.children[1] = build(mesh, order, middle, end);
  }
  nodes_[index] = std::move(node);
  return index;
}

double WindingNumber::at(const Vec3& p, std::size_t index) const {
  const Node& node = nodes_[index];
  if (!node.box.contains(p) && node.fan.size() < node.count) return winding(node.fan, p);
  if (node.children[0] == 0) return winding(node.triangles, p);
  return at(p, node.children[0]) + at(p, node.children[1]);
}

}  // namespace tenon::bench
