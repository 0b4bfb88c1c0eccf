#pragma once

#include <array>
#include <cmath>

#include "primitive/local_box.h"

namespace tenon {

/// A box with the planes of its faces, to be held against much.
struct FacedBox {
  const LocalBox& box;
  std::array<Vec3, 3> normals;  ///< of any length
  Vec3 reach;                   ///< along each normal, from the box's center

  explicit FacedBox(const LocalBox& the_box) : box(the_box) {
    for (std::size_t i = 0; i < 3; ++i) {
      normals[i] = cross(box.half_edges[(i + 1) % 3], box.half_edges[(i + 2) % 3]);
      reach[static_cast<int>(i)] = std::fabs(dot(normals[i], box.half_edges[i]));
    }
  }

  /// Whether a point lies within the box, as computed; none does in a flat one.
  bool contains(const Vec3& p) const {
    const Vec3 from_center = p - box.center;
    return std::fabs(dot(normals[0], from_center)) < reach.x && std::fabs(dot(normals[1], from_center)) < reach.y &&
           std::fabs(dot(normals[2], from_center)) < reach.z;
  }
};

}  // namespace tenon
