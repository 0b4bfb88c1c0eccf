#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "render/block.h"
#include "tenon/csg/hit.h"

namespace tenon {

/// Places where light scatters, brought together by their material and the media on both sides.
class VertexGroups {
 public:
  void add(const Hit& hit, std::uint32_t vertex) {
    const std::uint32_t group = group_of(hit);
    std::vector<std::uint32_t>& vertices = groups_[group].vertices;
    if (vertices.empty()) filled_.push_back(group);
    vertices.push_back(vertex);
  }

  /// Gives visit(vertices) what was added, a block of one group at a time, and is empty then.
  template <class Visit>
  void take_blocks(const Visit& visit) {
    for (const std::uint32_t group : filled_) {
      std::vector<std::uint32_t>& vertices = groups_[group].vertices;
      for (std::size_t at = 0; at < vertices.size(); at += block_size) {
        visit(std::span<const std::uint32_t>(vertices).subspan(at, std::min(block_size, vertices.size() - at)));
      }
      vertices.clear();
    }
    filled_.clear();
  }

 private:
  struct Group {
    MediumId before, after;
    std::vector<std::uint32_t> vertices;
  };

  std::uint32_t group_of(const Hit& hit) {
    const std::size_t material = hit.material ? hit.material.get() + 1 : 0;
    if (material >= of_material_.size()) of_material_.resize(material + 1);
    for (const std::uint32_t i : of_material_[material]) {
      if (groups_[i].before == hit.before && groups_[i].after == hit.after) return i;
    }
    groups_.push_back({hit.before, hit.after, {}});
    return of_material_[material].emplace_back(static_cast<std::uint32_t>(groups_.size() - 1));
  }

  std::vector<Group> groups_;
  std::vector<std::vector<std::uint32_t>> of_material_;  // into groups_; of no material, then of the scene's
  std::vector<std::uint32_t> filled_;
};

}  // namespace tenon
