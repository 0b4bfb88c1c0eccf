#include "accel/cells/leaf_regions.h"

#include <gtest/gtest.h>

#include "accel/cells/leaf_lanes.h"
#include "accel/random_solids.h"
#include "primitive/dispatch.h"

namespace tenon {
namespace {

using cells::LeafLanes;
using cells::LeafRegions;
using cells::RegionLeaf;
using fixtures::Draw;
using fixtures::SceneBuilder;

// Turned at random, or by quarter turns alone, and scaled alike.
SceneNodeId place(Draw& draw, SceneBuilder& b, SceneNodeId part) {
  const bool upright = draw.one_in(2);
  const auto angle = [&] { return upright ? 90.0 * draw.below(4) : draw.real(0, 360); };
  const SceneNodeId turned = b.rotate({angle(), angle(), angle()}, b.scale(draw.real(0.5, 2), part));
  return b.translate(draw.vector(-2, 2), turned);
}

// The kinds that are told without going through their frames, and others.
CsgTree many_kinds(Draw& draw) {
  SceneBuilder b;
  std::vector<SceneNodeId> parts;
  for (int i = 0; i < 6; ++i) {
    parts.push_back(place(draw, b, b.sphere(1)));
    parts.push_back(place(draw, b, b.cube(draw.vector(0.3, 2), draw.one_in(2))));
    parts.push_back(place(draw, b, b.cylinder(draw.real(0.3, 2), draw.real(0.3, 1))));
    parts.push_back(place(draw, b, b.torus(1, draw.real(0.05, 1))));
    parts.push_back(place(draw, b, b.transform(Affine3::scale({1, 1, 1.5}), b.sphere(1))));
  }
  return b.tree(b.unite(parts));
}

Box3 box_near(Draw& draw, const Box3& bounds) {
  const Vec3 at = draw.in_box(grown(bounds, 0.2));
  return {at - draw.vector(0, 0.5), at + draw.vector(0, 0.5)};
}

// What the primitive says of boxes too small to see, in its own frame.
bool holds(const CsgTree& tree, const Leaf& leaf, const Vec3& point, Region not_this) {
  const LocalBox place = leaf.placement.to_local(Box3{point, point});
  return classify(tree.primitives, leaf.primitive, place) != not_this;
}

TEST(LeafRegions, SayNothingOfABoxThatAPointOfItContradicts) {
  Draw draw(71);
  const CsgTree tree = many_kinds(draw);
  const LeafRegions regions(tree);
  std::array<std::size_t, 3> counts{};
  std::size_t straddling_by_frame = 0;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Leaf& leaf = tree.leaves[i];
    for (int round = 0; round < 400; ++round) {
      const Box3 box = box_near(draw, leaf.bounds);
      const Region region = regions.classify(LeafId{i}, box);
      ++counts[static_cast<std::size_t>(region)];
      straddling_by_frame +=
          classify(tree.primitives, leaf.primitive, leaf.placement.to_local(box)) == Region::straddles;
      if (region == Region::straddles) continue;
      const Region opposite = region == Region::inside ? Region::outside : Region::inside;
      for (int corner = 0; corner < 8; ++corner) {
        const Vec3 at{(corner & 1) != 0 ? box.upper.x : box.lower.x, (corner & 2) != 0 ? box.upper.y : box.lower.y,
                      (corner & 4) != 0 ? box.upper.z : box.lower.z};
        ASSERT_TRUE(holds(tree, leaf, at, opposite)) << "leaf " << i;
      }
      for (int k = 0; k < 20; ++k) ASSERT_TRUE(holds(tree, leaf, draw.in_box(box), opposite)) << "leaf " << i;
    }
  }
  // It tells about as much as going through the frames does.
  EXPECT_GT(counts[static_cast<std::size_t>(Region::inside)], 500u);
  EXPECT_GT(counts[static_cast<std::size_t>(Region::outside)], 500u);
  EXPECT_LT(static_cast<double>(counts[static_cast<std::size_t>(Region::straddles)]),
            1.1 * static_cast<double>(straddling_by_frame));
}

// Where a line crosses a leaf within a box, it does so within the smaller one.
TEST(LeafRegions, FindTheSurfaceWithinABox) {
  Draw draw(73);
  const CsgTree tree = many_kinds(draw);
  const LeafRegions regions(tree);
  std::size_t crossings = 0, smaller = 0, plain = 0;
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const Leaf& leaf = tree.leaves[i];
    for (int round = 0; round < 200; ++round) {
      const Box3 box = box_near(draw, leaf.bounds);
      const Box3 surface = regions.surface_within(regions[LeafId{i}], box);
      EXPECT_TRUE(box.contains(surface));
      if (regions[LeafId{i}].kind == RegionLeaf::Kind::plain) {
        ++plain;
        smaller += surface.surface_area() < 0.7 * box.surface_area();
      }
      for (int k = 0; k < 10; ++k) {
        const Vec3 in_box = draw.in_box(box), direction = draw.direction();
        const Ray ray{in_box - 10 * direction, direction};
        Spans spans;
        tenon::spans(tree.primitives, leaf.primitive, leaf.placement, ray, 0, -1, spans);
        for (const Crossing& crossing : spans) {
          const Vec3 at = ray.origin + crossing.t * ray.direction;
          if (!box.contains(at)) continue;
          ++crossings;
          ASSERT_TRUE(grown(surface, 0x1p-40).contains(at)) << "leaf " << i << ", round " << round;
        }
      }
    }
  }
  EXPECT_GT(crossings, 10000u);
  EXPECT_GT(2 * smaller, plain);
}

// Vectors say the same of the two sides of planes, but where rounding decides.
TEST(LeafRegions, SayTheSameSideBySide) {
  Draw draw(72);
  const CsgTree tree = many_kinds(draw);
  const LeafRegions regions(tree);
  constexpr double growth = 0x1p-16;
  std::size_t told = 0;
  for (int round = 0; round < 500; ++round) {
    LeafLanes lanes;
    std::array<LeafId, 6> leaves;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      leaves[i] = LeafId{static_cast<std::size_t>(draw.below(static_cast<int>(tree.leaves.size())))};
      lanes.set(i, regions[leaves[i]], regions.margin());
    }
    const Box3 box = box_near(draw, regions[leaves[0]].bounds);
    std::vector<cells::SplitPlane> planes;
    for (int axis = 0; axis < 3; ++axis) {
      for (int i = 0; i < 3; ++i)
        planes.push_back({axis, cells::evenly_spaced(box.lower[axis], box.upper[axis], i, 1)});
    }
    std::vector<cells::SideRegions> sides(planes.size());
    cells::classify_sides(lanes, box, planes, growth, sides);
    for (std::size_t p = 0; p < planes.size(); ++p) {
      std::array<Box3, 2> halves{box, box};
      halves[0].upper[planes[p].axis] = planes[p].position + growth;
      halves[1].lower[planes[p].axis] = planes[p].position - growth;
      for (std::size_t side = 0; side < 2; ++side) {
        for (std::size_t i = 0; i < leaves.size(); ++i) {
          const bool outside = (sides[p][side].outside >> i & 1) != 0, inside = (sides[p][side].inside >> i & 1) != 0;
          const Region region = outside ? Region::outside : inside ? Region::inside : Region::straddles;
          if ((lanes.shaped >> i & 1) != 0) {
            ASSERT_NE(region, Region::inside);
            if (region == Region::straddles) continue;
          }
          told += region != Region::straddles;
          ASSERT_EQ(region, regions.classify(leaves[i], halves[side])) << "round " << round;
        }
      }
    }
  }
  EXPECT_GT(told, 5000u);
}

TEST(SplitPlane, EvenlySpacedOnesBeginInTheMiddle) {
  EXPECT_EQ(cells::evenly_spaced(1, 3, 0, 0), 2);
  EXPECT_EQ(cells::evenly_spaced(0, 4, 0, 1), 2);
  EXPECT_EQ(cells::evenly_spaced(0, 4, 1, 1), 1);
  EXPECT_EQ(cells::evenly_spaced(0, 4, 2, 1), 3);
}

}  // namespace
}  // namespace tenon
