#include "primitive/mesh_edges.h"

#include <algorithm>

namespace tenon {

std::vector<EdgeUse> sorted_edge_uses(std::span<const TriangleMesh::Corners> triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
      uses.push_back({std::min(a, b), std::max(a, b), static_cast<std::uint32_t>(t), a < b});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.triangle < b.triangle;
  });
  return uses;
}

std::optional<OpenEdges> find_open_edges(std::span<const TriangleMesh::Corners> triangles) {
  const std::vector<EdgeUse> uses = sorted_edge_uses(triangles);
  OpenEdges open;
  for (std::size_t begin = 0, end; begin < uses.size(); begin = end) {
    end = begin;
    std::size_t rising = 0;
    while (end < uses.size() && uses[end].low == uses[begin].low && uses[end].high == uses[begin].high) {
      rising += uses[end++].rising;
    }
    const std::size_t falling = end - begin - rising;
    if (rising == falling) continue;
    ++open.count;
    const bool more_rising = rising > falling;
    const auto first = std::find_if(uses.begin() + static_cast<std::ptrdiff_t>(begin), uses.end(),
                                    [more_rising](const EdgeUse& use) { return use.rising == more_rising; });
    if (open.count > 1 && first->triangle >= open.triangle) continue;
    open.triangle = first->triangle;
    open.from = more_rising ? first->low : first->high;
    open.to = more_rising ? first->high : first->low;
    open.forth = std::max(rising, falling);
    open.back = std::min(rising, falling);
  }
  if (open.count == 0) return std::nullopt;
  return open;
}

}  // namespace tenon
