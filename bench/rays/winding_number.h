#pragma once

#include <array>
#include <vector>

#include "tenon/math/box3.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon::bench {

/// The generalised winding number of a triangle mesh (Jacobson, Kavan, Sorkine-Hornung, "Robust Inside-Outside
/// Segmentation using Generalized Winding Numbers", 2013): the solid angle that the mesh spans at a point, over 4 pi.
/// No ray is cast, so that it can judge those who do.
///
/// Seen from outside of a box, the triangles in it span as much as any others with the same border (§4): a fan over
/// that border stands for them where it has fewer.
class WindingNumber {
 public:
  explicit WindingNumber(const tenon::TriangleMesh& mesh);

  double at(const Vec3& p) const { return nodes_.empty() ? 0 : at(p, 0); }

 private:
  using Triangle = std::array<Vec3, 3>;
  struct Node {
    Box3 box;
    std::vector<Triangle> triangles;  // of a leaf
    std::vector<Triangle> fan;        // the same border as all triangles below
    std::size_t count = 0;            // of them
    std::size_t children[2] = {0, 0};
  };

  std::size_t build(const tenon::TriangleMesh& mesh, std::vector<std::uint32_t>& order, std::size_t begin,
                    std::size_t end);
  double at(const Vec3& p, std::size_t node) const;

  std::vector<Node> nodes_;
};

}  // namespace tenon::bench
