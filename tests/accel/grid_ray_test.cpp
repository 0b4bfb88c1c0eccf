#include "accel/grid_ray.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "accel/grid_steps.h"

namespace tenon {
namespace {

constexpr double inf = std::numeric_limits<double>::infinity();

GridGeometry unit_cells(std::uint32_t n) {
  const double size = n;
  return {{{0, 0, 0}, {size, size, size}}, {n, n, n}};
}

// The cells a ray passes, when every box is one cell.
std::vector<CellIndex> way_of(const GridGeometry& grid, const Ray& ray) {
  std::vector<CellIndex> way;
  GridRay grid_ray(grid, ray);
  if (!grid_ray.enter()) return way;
  CellRange box;
  do {
    way.push_back(grid_ray.cell());
    box = {grid_ray.cell(), grid_ray.cell()};
    grid_ray.exit(box);
    if (way.size() > 3 * grid.count(0)) ADD_FAILURE() << "the ray circles";
  } while (way.size() <= 3 * grid.count(0) && grid_ray.next_box(box));
  return way;
}

template <class Steps>
std::vector<CellIndex> steps_of(const GridGeometry& grid, const Ray& ray) {
  std::vector<CellIndex> way;
  Steps steps(grid, ray);
  if (!steps.enter()) return way;
  do {
    way.push_back(steps.cell());
    steps.exit();
  } while (steps.next());
  return way;
}

TEST(GridRay, LeavesThroughAFace) {
  EXPECT_EQ(way_of(unit_cells(4), {{-1, 0.5, 0.5}, {1, 0, 0}}),
            (std::vector<CellIndex>{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(way_of(unit_cells(4), {{1.5, 0.5, 3.5}, {0, 0, -2}}),
            (std::vector<CellIndex>{{1, 0, 3}, {1, 0, 2}, {1, 0, 1}, {1, 0, 0}}));
}

TEST(GridRay, IsPushedAlongTwoNormalsAtAnEdge) {
  EXPECT_EQ(way_of(unit_cells(3), {{0.5, 0.5, 0.5}, {1, 1, 0}}),
            (std::vector<CellIndex>{{0, 0, 0}, {1, 1, 0}, {2, 2, 0}}));
  EXPECT_EQ(way_of(unit_cells(3), {{2.5, 0.5, 0.5}, {-1, 1, 0}}),
            (std::vector<CellIndex>{{2, 0, 0}, {1, 1, 0}, {0, 2, 0}}));
}

TEST(GridRay, IsPushedAlongThreeNormalsAtAVertex) {
  EXPECT_EQ(way_of(unit_cells(3), {{3, 3, 3}, {-1, -1, -1}}),
            (std::vector<CellIndex>{{2, 2, 2}, {1, 1, 1}, {0, 0, 0}}));
  EXPECT_EQ(way_of(unit_cells(3), {{-1, -1, 4}, {2, 2, -2}}),
            (std::vector<CellIndex>{{0, 0, 2}, {1, 1, 1}, {2, 2, 0}}));
}

TEST(GridRay, InAFaceStaysOnOneSideOfIt) {
  EXPECT_EQ(way_of(unit_cells(3), {{-1, 1, 2}, {1, 0, 0}}), (std::vector<CellIndex>{{0, 1, 2}, {1, 1, 2}, {2, 1, 2}}));
  // In the maximal faces: they belong to the last cells.
  EXPECT_EQ(way_of(unit_cells(2), {{-1, 2, 2}, {1, 0, 0}}), (std::vector<CellIndex>{{0, 1, 1}, {1, 1, 1}}));
}

TEST(GridRay, ThatMissesOrStartsBeyondTheSpacePassesNothing) {
  EXPECT_TRUE(way_of(unit_cells(2), {{-1, 3, 1}, {1, 0, 0}}).empty());
  EXPECT_TRUE(way_of(unit_cells(2), {{3, 1, 1}, {1, 0, 0}}).empty());
  EXPECT_TRUE(way_of(unit_cells(2), {{0, -1, 0}, {-1, 0, 0}}).empty());
}

TEST(GridRay, EntersALargeBoxAndLeavesItBesideTheRay) {
  // Box 0 covers the cells x < 2; behind it single cells.
  const GridGeometry grid = unit_cells(4);
  GridRay ray(grid, {{0.5, 0.5, 0.5}, {1, 1.2, 0}});
  ASSERT_TRUE(ray.enter());
  const CellRange large{{0, 0, 0}, {1, 3, 3}};
  EXPECT_EQ(ray.exit(large), 1.5);
  ASSERT_TRUE(ray.next_box(large));
  EXPECT_EQ(ray.cell(), (CellIndex{2, 2, 0}));
}

TEST(GridRay, NeitherCirclesNorSkipsAtFacesEdgesAndVertices) {
  // Rays between points of a lattice of half cells meet faces, edges and vertices all the time, from near and far.
  const GridGeometry grid = unit_cells(4);
  std::mt19937_64 rng(4);
  const auto half = [&rng] { return 0.5 * static_cast<double>(rng() % 13) - 1; };
  for (int round = 0; round < 20000; ++round) {
    const Vec3 a{half(), half(), half()}, b{half(), half(), half()};
    if (a == b) continue;
    const double far = round % 3 == 0 ? 0x1p12 : round % 3 == 1 ? 1 : 0;
    const Ray ray{a - far * (b - a), (b - a) * (1.0 / 3)};
    const std::vector<CellIndex> way = way_of(grid, ray);
    // Every point of the ray lies in a cell of its way, or in the face of one.
    for (int i = 0; i < 64; ++i) {
      const Vec3 p = a + (b - a) * (i / 16.0);
      if (!grown(grid.space(), -0x1p-36).contains(p)) continue;
      bool held = false;
      for (const CellIndex& cell : way) held |= grown(grid.box({cell, cell}), 0x1p-36).contains(p);
      ASSERT_TRUE(held) << p.x << ' ' << p.y << ' ' << p.z;
    }
    for (std::size_t i = 1; i < way.size(); ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double d = ray.direction[static_cast<int>(axis)];
        ASSERT_TRUE(d < 0 || way[i][axis] >= way[i - 1][axis]);
        ASSERT_TRUE(d > 0 || way[i][axis] <= way[i - 1][axis]);
      }
    }
  }
}

TEST(GridSteps, ClassicAndAmanatidesPassTheSameCells) {
  std::mt19937_64 rng(1987);
  std::uniform_real_distribution<double> number(-8, 24);
  const GridGeometry grid({{0, 1, -3}, {16, 13, 14}}, {32, 5, 17});
  std::size_t cells = 0;
  for (int round = 0; round < 20000; ++round) {
    const Vec3 a{number(rng), number(rng), number(rng)}, b{number(rng), number(rng), number(rng)};
    const std::vector<CellIndex> classic = steps_of<ClassicSteps>(grid, {a, b - a});
    ASSERT_EQ(steps_of<AmanatidesSteps>(grid, {a, b - a}), classic);
    cells += classic.size();
    // Through no edge, pushing passes them too.
    GridRay ray(grid, {a, b - a});
    if (!ray.enter()) continue;
    for (const CellIndex& cell : classic) {
      ASSERT_EQ(ray.cell(), cell);
      ASSERT_LT(ray.exit({cell, cell}), inf);
      const bool inside = ray.next_box({cell, cell});
      ASSERT_EQ(inside, &cell != &classic.back());
    }
  }
  EXPECT_GT(cells, 100000u);
}

TEST(GridSteps, PassAxesThatAreParallelToTheRay) {
  const GridGeometry grid = unit_cells(3);
  const std::vector<CellIndex> along{{0, 1, 2}, {1, 1, 2}, {2, 1, 2}};
  EXPECT_EQ(steps_of<ClassicSteps>(grid, {{-1, 1, 2}, {1, 0, -0.0}}), along);
  EXPECT_EQ(steps_of<AmanatidesSteps>(grid, {{-1, 1, 2}, {1, 0, -0.0}}), along);
  EXPECT_TRUE(steps_of<AmanatidesSteps>(grid, {{-1, 1, 4}, {1, 0, 0}}).empty());
}

}  // namespace
}  // namespace tenon
