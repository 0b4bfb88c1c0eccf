#include "accel/midpoint_subdivision.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "accel/spatial_index.h"

namespace tenon {
namespace {

struct Scene {
  Projection projection;
  MidpointBox root;
};

Scene scene_of(const std::vector<Box3>& enclosures) {
  std::vector<LeafId> leaves;
  for (std::size_t i = 0; i < enclosures.size(); ++i) leaves.emplace_back(i);
  return {Projection(enclosures, false), {{}, {}, subtree_of(leaves), leaves.size()}};
}

std::vector<Box3> random_boxes(std::mt19937_64& rng, std::size_t count) {
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Box3> boxes;
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 p{number(rng), number(rng), number(rng)};
    boxes.push_back(grown({p, p}, 0.1 * number(rng)));
  }
  return boxes;
}

constexpr Box3 space{{-0.2, -0.2, -0.2}, {1.2, 1.2, 1.2}};

TEST(MidpointSubdivision, BoxesFillSpaceOnceAndHoldWhatTouchesThem) {
  std::mt19937_64 rng(3);
  for (int round = 0; round < 20; ++round) {
    const std::vector<Box3> enclosures = random_boxes(rng, 30);
    Scene scene = scene_of(enclosures);
    SubdivisionLimits limits;
    limits.levels = {4, 3, 2};
    limits.primitives = 2;
    limits.held = SubdivisionLimits::usual_held(enclosures.size());
    const GridGeometry grid = midpoint_grid(space, limits.levels);
    const std::vector<MidpointBox> boxes = subdivide(grid, scene.root, limits, scene.projection);

    std::set<CellIndex> covered;
    for (const MidpointBox& box : boxes) {
      const CellRange cells = box.cells(limits.levels);
      for (std::uint32_t i = cells.first[0]; i <= cells.last[0]; ++i) {
        for (std::uint32_t j = cells.first[1]; j <= cells.last[1]; ++j) {
          for (std::uint32_t k = cells.first[2]; k <= cells.last[2]; ++k) {
            EXPECT_TRUE(covered.insert({i, j, k}).second);
          }
        }
      }
      std::size_t touching = 0;
      for (const Box3& e : enclosures) touching += e.overlaps(grid.box(cells));
      EXPECT_EQ(box.primitives, touching);
      EXPECT_TRUE(touching <= limits.primitives || box.level == limits.levels);
      // Axes take turns until they reach their levels.
      EXPECT_LE(std::min(box.level[1], 2), box.level[0]);
      EXPECT_LE(std::min(box.level[0] - 1, 2), box.level[2]);
    }
    EXPECT_EQ(covered.size(), 16u * 8u * 4u);
  }
}

TEST(MidpointSubdivision, AddressesAreThoseOfThePaper) {
  // One primitive in the corner of largest coordinates and one across the middle: x is halved, then y, then z.
  Scene scene = scene_of({{{0.9, 0.9, 0.9}, {1, 1, 1}}, {{0.6, 0.6, 0.6}, {0.8, 0.8, 0.8}}});
  SubdivisionLimits limits;
  limits.levels = {2, 2, 2};
  limits.held = 1000;
  const GridGeometry grid = midpoint_grid({{0, 0, 0}, {1, 1, 1}}, limits.levels);
  const std::vector<MidpointBox> boxes = subdivide(grid, scene.root, limits, scene.projection);
  ASSERT_GE(boxes.size(), 4u);
  EXPECT_EQ(boxes[0].address, (CellIndex{0, 0, 0}));  // x < 1/2: empty
  EXPECT_EQ(boxes[0].level, (Levels{1, 0, 0}));
  EXPECT_EQ(boxes[1].address, (CellIndex{1, 0, 0}));  // of the other half, y < 1/2
  EXPECT_EQ(boxes[1].level, (Levels{1, 1, 0}));
  EXPECT_EQ(boxes[2].address, (CellIndex{1, 1, 0}));
  EXPECT_EQ(boxes[2].level, (Levels{1, 1, 1}));
  // Halving 0.5..1 at 0.75 leaves the second in both halves: 2 * 1 + 0 and 2 * 1 + 1.
  EXPECT_EQ(boxes[3].address[0], 2u);
  EXPECT_EQ(boxes[3].cells(limits.levels).first[0], 2u);
  EXPECT_EQ(boxes[0].cells(limits.levels), (CellRange{{0, 0, 0}, {1, 3, 3}}));
}

TEST(MidpointSubdivision, StopsWhereSplittingSeparatesNothing) {
  const std::vector<Box3> enclosures(1000, Box3{{0, 0, 0}, {1, 1, 1}});
  Scene scene = scene_of(enclosures);
  SubdivisionLimits limits;
  limits.levels = {10, 10, 10};
  limits.held = 50000;
  const std::vector<MidpointBox> boxes =
      subdivide(midpoint_grid(space, limits.levels), scene.root, limits, scene.projection);
  std::size_t held = 0;
  for (const MidpointBox& box : boxes) held += 1 + box.primitives;
  EXPECT_LE(held, limits.held);
  EXPECT_GT(boxes.size(), 8u);
}

TEST(MidpointSubdivision, FlatSpaceIsNotHalvedAlongItsFlatAxis) {
  EXPECT_EQ(useful_levels({5, 5, 5}, {{0, 0, 0}, {1, 1, 1e-9}}, 1e-8), (Levels{5, 5, 0}));
  EXPECT_EQ(useful_levels({5, 5, 5}, {{0, 0, 0}, {1, 1, 0.25}}, 0.0625), (Levels{4, 4, 2}));
}

TEST(SpatialIndex, FindsTheBoxOfAnyPoint) {
  std::mt19937_64 rng(34);
  std::uniform_real_distribution<double> number(-0.2, 1.2);
  Scene scene = scene_of(random_boxes(rng, 40));
  SubdivisionLimits limits;
  limits.levels = {3, 5, 4};
  limits.held = 1 << 20;
  const GridGeometry grid = midpoint_grid(space, limits.levels);
  const std::vector<MidpointBox> boxes = subdivide(grid, scene.root, limits, scene.projection);
  SpatialIndex index(limits.levels);
  EXPECT_EQ(index.memory_bytes(), SpatialIndex::memory_bytes(limits.levels));
  for (std::size_t n = 0; n < boxes.size(); ++n) {
    index.fill(boxes[n].cells(limits.levels), static_cast<SpatialIndex::Number>(n));
  }
  for (int round = 0; round < 20000; ++round) {
    const Vec3 p{number(rng), number(rng), number(rng)};
    std::size_t holding = 0, found = boxes.size();
    for (std::size_t n = 0; n < boxes.size(); ++n) {
      if (!grid.box(boxes[n].cells(limits.levels)).contains(p)) continue;
      ++holding;
      found = n;
    }
    ASSERT_EQ(holding, 1u);
    ASSERT_EQ(index.at(grid.index(p)), found);
  }
  // The maximal faces, where the paper's formula gives a number too many, and beyond.
  EXPECT_EQ(grid.index(space.upper), (CellIndex{7, 31, 15}));
  EXPECT_EQ(grid.index({9, -9, std::numeric_limits<double>::quiet_NaN()}), (CellIndex{7, 0, 0}));
}

TEST(SpatialIndex, SaysWhatItWouldNeedWhenThatIsTooMuch) {
  EXPECT_TRUE(check_index_bytes("s", SpatialIndex::memory_bytes({8, 8, 8}), "").ok());
  const Status status = check_index_bytes("s", SpatialIndex::memory_bytes({10, 10, 10}), "choose fewer levels");
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message,
            "s: the spatial index would need 4096 MiB, more than the 64 MiB it may take; choose fewer levels");
}

}  // namespace
}  // namespace tenon
