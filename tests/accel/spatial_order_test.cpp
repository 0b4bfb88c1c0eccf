#include "accel/cells/spatial_order.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "accel/random_solids.h"

namespace tenon {
namespace {

// Balls at random places.
TEST(SpatialOrder, HoldsEveryLeafAndPutsNeighboursTogether) {
  fixtures::Draw draw(5);
  fixtures::SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 500; ++i) parts.push_back(b.translate(draw.vector(-10, 10), b.sphere(0.1)));
  const CsgTree tree = b.tree(b.unite(parts));
  std::vector<LeafId> order = cells::spatial_order(tree, 10.1);
  ASSERT_EQ(order.size(), tree.leaves.size());

  const auto steps = [&](const std::vector<LeafId>& leaves) {
    double sum = 0;
    for (std::size_t i = 1; i < leaves.size(); ++i) {
      sum += length(tree[leaves[i]].bounds.center() - tree[leaves[i - 1]].bounds.center());
    }
    return sum;
  };
  const double along = steps(order);
  std::sort(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(order[i], LeafId{i});
  EXPECT_LT(along, steps(order) / 3);
}

}  // namespace
}  // namespace tenon
