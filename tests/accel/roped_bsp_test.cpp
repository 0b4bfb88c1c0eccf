#include "accel/roped_bsp.h"

#include <gtest/gtest.h>

#include "accel/enclosed_boxes.h"

namespace tenon {
namespace {

RopedBsp roped(std::uint64_t seed, std::size_t count, BspSplit split) {
  std::mt19937_64 rng(seed);
  const auto leaves = boxes::enclosed(boxes::random_boxes(rng, count));
  return RopedBsp(build_bsp_tree(leaves, hull_of(leaves, 0.01), {split, 2, 20}));
}

// A point of the face, and the direction that leaves the cell there.
struct FacePoint {
  Vec3 point;
  Vec3 direction;
};

FacePoint random_face_point(std::mt19937_64& rng, const Box3& cell, CellFace face) {
  FacePoint p{boxes::random_point(rng, cell), boxes::random_point(rng, {{-1, -1, -1}, {1, 1, 1}})};
  // At times on an edge, in a corner or along the face.
  for (int axis = 0; axis < 3; ++axis) {
    const auto choice = rng() % 8;
    if (choice == 0) p.point[axis] = cell.lower[axis];
    if (choice == 1) p.point[axis] = cell.upper[axis];
    if (choice == 2) p.direction[axis] = 0;
  }
  p.point[face.axis] = (face.above ? cell.upper : cell.lower)[face.axis];
  p.direction[face.axis] = face.above ? 1 : -1;
  return p;
}

// Follows the rope from random points of every face, against the way from the root.
void expect_ropes_lead_where_the_root_does(const RopedBsp& bsp, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  std::uint64_t visited = 0;
  for (const RopedCell& cell : bsp.cells()) {
    for (const int axis : {0, 1, 2}) {
      for (const bool above : {false, true}) {
        const CellFace face{axis, above};
        const std::uint32_t rope = cell.ropes[face.index()];
        const double at = (above ? cell.box.upper : cell.box.lower)[axis];
        ASSERT_EQ(rope == RopedCell::none, at == (above ? bsp.box().upper : bsp.box().lower)[axis]);
        if (rope == RopedCell::none) continue;
        for (int i = 0; i < 10; ++i) {
          auto [point, direction] = random_face_point(rng, cell.box, face);
          // Strictly inside the face the two ways must agree; on its edges the rope may give any cell that touches.
          const std::uint32_t found = bsp.locate(rope, point, direction, visited);
          const Box3& next = bsp.cells()[found].box;
          EXPECT_TRUE(next.contains(point));
          EXPECT_EQ((above ? next.lower : next.upper)[axis], at);
          bool on_edge = false;
          for (const int other : {(axis + 1) % 3, (axis + 2) % 3}) {
            on_edge |= point[other] == cell.box.lower[other] || point[other] == cell.box.upper[other];
          }
          if (!on_edge) {
            EXPECT_EQ(found, bsp.locate(0, point, direction, visited));
          }
        }
      }
    }
  }
}

TEST(Ropes, LeadToTheCellThatTheRootLeadsTo) {
  for (const BspSplit split : {BspSplit::kaplan, BspSplit::macdonald_booth}) {
    expect_ropes_lead_where_the_root_does(roped(1, 200, split), 2);
  }
}

TEST(RopeTrees, LeadToTheCellThatTheRootLeadsTo) {
  for (const BspSplit split : {BspSplit::kaplan, BspSplit::macdonald_booth}) {
    RopedBsp bsp = roped(3, 200, split);
    bsp.plant_rope_trees(10'000'000);
    expect_ropes_lead_where_the_root_does(bsp, 4);
  }
}

TEST(Ropes, PointToTheSmallestNodeThatHoldsAllNeighbours) {
  const RopedBsp bsp = roped(5, 150, BspSplit::kaplan);
  for (const RopedCell& cell : bsp.cells()) {
    for (const int axis : {0, 1, 2}) {
      for (const bool above : {false, true}) {
        const CellFace face{axis, above};
        const std::uint32_t rope = cell.ropes[face.index()];
        if (rope == RopedCell::none || bsp.nodes()[rope].is_leaf()) continue;
        EXPECT_EQ(side_of_face(bsp.nodes()[rope], cell.box, face), FaceSide::both);
      }
    }
  }
}

// All that a pruned tree holds cuts the face or touches it, and each of its cells is there once.
TEST(RopeTrees, HoldOnlyWhatTouchesTheFace) {
  RopedBsp bsp = roped(6, 200, BspSplit::macdonald_booth);
  const std::size_t plain = bsp.nodes().size();
  bsp.plant_rope_trees(10'000'000);
  EXPECT_GT(bsp.nodes().size(), plain);
  for (const RopedCell& cell : bsp.cells()) {
    for (const int axis : {0, 1, 2}) {
      for (const bool above : {false, true}) {
        const CellFace face{axis, above};
        if (cell.ropes[face.index()] == RopedCell::none) continue;
        std::vector<std::uint32_t> pending{cell.ropes[face.index()]}, found;
        while (!pending.empty()) {
          const BspNode& node = bsp.nodes()[pending.back()];
          pending.pop_back();
          if (node.is_leaf()) {
            found.push_back(node.first);
            continue;
          }
          EXPECT_EQ(side_of_face(node, cell.box, face), FaceSide::both);
          pending.push_back(node.first);
          pending.push_back(node.first + 1);
        }
        std::size_t neighbours = 0;
        for (std::uint32_t i = 0; i < bsp.cells().size(); ++i) {
          const Box3& other = bsp.cells()[i].box;
          bool touches = (above ? other.lower : other.upper)[axis] == (above ? cell.box.upper : cell.box.lower)[axis];
          for (const int a : {(axis + 1) % 3, (axis + 2) % 3}) {
            touches &= other.lower[a] < cell.box.upper[a] && cell.box.lower[a] < other.upper[a];
          }
          if (touches) ++neighbours;
        }
        EXPECT_EQ(found.size(), neighbours);
      }
    }
  }
}

TEST(RopeTrees, StopWhereMemoryEnds) {
  RopedBsp bsp = roped(7, 200, BspSplit::kaplan);
  bsp.plant_rope_trees(bsp.nodes().size() + 100);
  EXPECT_LE(bsp.nodes().size(), roped(7, 200, BspSplit::kaplan).nodes().size() * 2 + 100);
  expect_ropes_lead_where_the_root_does(bsp, 8);
}

}  // namespace
}  // namespace tenon
