#include "mesh/self_intersection.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "mesh/triangle_pair.h"
#include "support/meshes.h"
#include "support/random.h"

namespace tenon {
namespace {

TEST(SelfIntersection, MeshesThatOnlyTouchThemselvesHaveNone) {
  Random random(3);
  const auto box = meshes::box({0, 0, 0}, {1, 1, 1});
  EXPECT_FALSE(find_self_intersection(box));
  EXPECT_FALSE(find_self_intersection(meshes::ring(1, 0.4, 9, 7)));
  for (int i = 0; i < 20; ++i) {
    EXPECT_FALSE(find_self_intersection(meshes::star(3, [&](const Vec3&) { return random.uniform(0.2, 1); })));
  }
  // Beside one another with a common face, with a common edge, and one within the other.
  EXPECT_FALSE(find_self_intersection(meshes::together(box, meshes::box({1, 0, 0}, {2, 1, 1}))));
  EXPECT_FALSE(find_self_intersection(meshes::together(box, meshes::box({1, 1, 0.3}, {2, 2, 0.7}))));
  EXPECT_FALSE(find_self_intersection(meshes::together(box, meshes::box({0.2, 0.2, 0.2}, {0.7, 0.7, 0.7}))));
}

TEST(SelfIntersection, PartsThatPassThroughOneAnotherAreFound) {
  Random random(4);
  const auto ball = meshes::star(3, [](const Vec3&) { return 1.0; });
  for (int i = 0; i < 50; ++i) {
    const double apart = random.uniform(0.1, 4);
    const auto other = meshes::scaled(ball, {1, 1, 1}, apart * random.direction());
    const auto found = find_self_intersection(meshes::together(ball, other));
    // The inscribed spheres of the balls have radius 0.98 and more.
    ASSERT_TRUE(found || apart > 1.95) << apart;
    ASSERT_TRUE(!found || apart < 2) << apart;
    if (!found) continue;
    EXPECT_LT(found->first, ball.triangles.size());
    EXPECT_GE(found->second, ball.triangles.size());
    EXPECT_NEAR(length(found->place), 1, 0.03);
  }
}

// However small the part that passes through, and however large the numbers around it.
TEST(SelfIntersection, ATipThroughAFaceIsOnePairOfThree) {
  for (const double depth : {0.5, 1e-3, 1e-9}) {
    TriangleMesh tip;
    tip.vertices = {{0.3, 0.2, 1 - depth}, {0.25, 0.15, 2}, {0.4, 0.15, 2}, {0.3, 0.3, 2}};
    tip.triangles = {{1, 2, 3}, {0, 2, 1}, {0, 3, 2}, {0, 1, 3}};
    const auto found = find_self_intersection(meshes::together(meshes::box({0, 0, 0}, {1, 1, 1}), tip));
    ASSERT_TRUE(found) << depth;
    EXPECT_EQ(found->count, 3u) << depth;
    EXPECT_NEAR(found->place.z, 1, 1e-12);
  }
}

// Solids of unit cubes, each face in two triangles, and how often they contain each cube.
class Blocks {
 public:
  static constexpr int size = 9;
  using Place = std::array<int, 3>;

  // The faces of all cubes, those between two cubes left out, with shared vertices.
  TriangleMesh mesh() const {
    TriangleMesh mesh;
    std::map<Place, std::uint32_t> known;
    const auto vertex = [&](const Place& p) {
      const auto [found, is_new] = known.try_emplace(p, static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back({1.0 * p[0], 1.0 * p[1], 1.0 * p[2]});
      return found->second;
    };
    for (const Place& cube : cubes) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        for (const int side : {0, 1}) {
          Place beyond = cube;
          beyond[axis] += 2 * side - 1;
          if (cubes.count(beyond) != 0) continue;
          std::array<std::uint32_t, 4> corners{};
          for (std::size_t k = 0; k < 4; ++k) {
            Place p = cube;
            p[axis] += side;
            p[(axis + 1) % 3] += k == 1 || k == 2;
            p[(axis + 2) % 3] += k >= 2;
            corners[k] = vertex(p);
          }
          if (side == 0) std::swap(corners[1], corners[3]);
          mesh.triangles.push_back({corners[0], corners[1], corners[2]});
          mesh.triangles.push_back({corners[0], corners[2], corners[3]});
        }
      }
    }
    return mesh;
  }

  bool has(const Place& cube) const { return cubes.count(cube) != 0; }

  std::set<Place> cubes;
};

// A random solid within [0, 3]^3.
Blocks random_blocks(Random& random) {
  Blocks blocks;
  for (int i = 0; i < 27; ++i) {
    if (random.chance(0.15)) blocks.cubes.insert({i % 3, i / 3 % 3, i / 9});
  }
  return blocks;
}

// The solid made `times` as large, and moved.
Blocks placed(const Blocks& blocks, int times, const Blocks::Place& shift) {
  Blocks result;
  for (const auto& [x, y, z] : blocks.cubes) {
    for (int j = 0; j < times * times * times; ++j) {
      result.cubes.insert({times * x + j % times + shift[0], times * y + j / times % times + shift[1],
                           times * z + j / (times * times) + shift[2]});
    }
  }
  return result;
}

TriangleMesh placed(TriangleMesh mesh, int times, const Blocks::Place& shift) {
  const double factor = times;
  return meshes::scaled(std::move(mesh), {factor, factor, factor}, {1.0 * shift[0], 1.0 * shift[1], 1.0 * shift[2]});
}

TriangleMesh turned_inside_out(TriangleMesh mesh) {
  for (TriangleMesh::Corners& corners : mesh.triangles) std::swap(corners[1], corners[2]);
  return mesh;
}

// Whether, in a face or an edge of a cube that bounds both solids, how many solids one is in takes three values around
// it, or differs by two.
bool overlap_in_boundary(const Blocks& a, const Blocks& b, int sense_of_b) {
  const auto within = [&](const Blocks::Place& cube) { return int{a.has(cube)} + sense_of_b * int{b.has(cube)}; };
  for (int i = 0; i < Blocks::size * Blocks::size * Blocks::size; ++i) {
    const Blocks::Place p{i % Blocks::size, i / Blocks::size % Blocks::size, i / Blocks::size / Blocks::size};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<Blocks::Place> around;
      for (const auto& [j, k] : {std::pair{0, 0}, {1, 0}, {0, 1}, {1, 1}}) {
        around.push_back(p);
        around.back()[(axis + 1) % 3] -= j;
        around.back()[(axis + 2) % 3] -= k;
      }
      const auto bounds = [&](const Blocks& solid, std::size_t count) {
        return std::any_of(around.begin(), around.begin() + static_cast<std::ptrdiff_t>(count),
                           [&](const auto& cube) { return solid.has(cube) != solid.has(around[0]); });
      };
      for (const std::size_t count : {2u, 4u}) {
        if (!bounds(a, count) || !bounds(b, count)) continue;
        int least = 2, most = -2;
        for (std::size_t k = 0; k < count; ++k) {
          least = std::min(least, within(around[k]));
          most = std::max(most, within(around[k]));
        }
        if (most - least > 1) return true;
      }
    }
  }
  return false;
}

// Everything these have in common lies in faces, edges and corners, and no coordinate is off.
TEST(SelfIntersection, SolidsThatMeetInEdgesAndFacesAloneAreToldExactly) {
  Random random(5);
  int touching = 0, overlapping = 0;
  for (int i = 0; i < 200; ++i) {
    SCOPED_TRACE(i);
    const Blocks large = random_blocks(random), small = random_blocks(random);
    const Blocks::Place there{1, 1, 1}, here{1 + random.below(5), 1 + random.below(5), 1 + random.below(5)};
    const int sense = i % 3 == 2 ? -1 : 1;
    const TriangleMesh other = placed(small.mesh(), 1, here);
    TriangleMesh both = meshes::together(placed(large.mesh(), 2, there), sense < 0 ? turned_inside_out(other) : other);
    if (i % 2 == 1) {
      // Turned by a matrix of integers: not along the axes, and still without rounding.
      for (Vec3& v : both.vertices) {
        v = {v.x + 2 * v.y + 2 * v.z, 2 * v.x + v.y - 2 * v.z, 2 * v.y - 2 * v.x - v.z};
      }
    }
    const bool expected = overlap_in_boundary(placed(large, 2, there), placed(small, 1, here), sense);
    EXPECT_EQ(find_self_intersection(both).has_value(), expected);
    ++(expected ? overlapping : touching);
  }
  EXPECT_GT(touching, 20);
  EXPECT_GT(overlapping, 20);
}

// A solid of blocks alone may touch itself in edges and corners.
TEST(SelfIntersection, SharedEdgesOfMoreThanTwoTrianglesAreNoneByThemselves) {
  Random random(6);
  for (int i = 0; i < 50; ++i) EXPECT_FALSE(find_self_intersection(random_blocks(random).mesh()));
}

// Two wedges around one edge, of which both vertices are shared.
TEST(SelfIntersection, SolidsThatOverlapInASharedEdgeAreFound) {
  const auto wedge = [](const Vec3& p, const Vec3& q) {
    TriangleMesh mesh;
    mesh.vertices = {{0, 0, 0}, {0, 0, 1}, p, q};
    mesh.triangles = {{0, 3, 2}, {1, 2, 3}, {0, 2, 1}, {0, 1, 3}};
    return mesh;
  };
  const auto joined = [&](const Vec3& p, const Vec3& q) {
    TriangleMesh mesh = wedge({1, 0, 0.5}, {0, 1, 0.5});
    mesh.vertices.push_back(p);
    mesh.vertices.push_back(q);
    for (const auto& [a, b, c] : wedge(p, q).triangles) {
      const auto moved = [](std::uint32_t v) { return v < 2 ? v : v + 2; };
      mesh.triangles.push_back({moved(a), moved(b), moved(c)});
    }
    return mesh;
  };
  EXPECT_FALSE(find_self_intersection(joined({-1, 0, 0.25}, {0, -1, 0.25})));
  EXPECT_FALSE(find_self_intersection(joined({0, 1, 0.25}, {-1, 0, 0.25})));
  EXPECT_TRUE(find_self_intersection(joined({2, 3, 0.25}, {-1, 0, 0.25})));
  EXPECT_TRUE(find_self_intersection(joined({3, 1, 0.5}, {1, 3, 0.5})));
}

// Triangles at random, against what double says of where edges pass through faces.
TEST(SelfIntersection, TrianglesAtRandomPassThroughOneAnotherWhereAnEdgeDoes) {
  Random random(7);
  const auto point = [&] { return Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)}; };
  const auto pierces = [](const Vec3& p, const Vec3& q, const Triangle& t) {
    const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
    const double from = dot(n, p - t[0]), to = dot(n, q - t[0]);
    if ((from > 0) == (to > 0)) return false;
    const Vec3 at = p + from / (from - to) * (q - p);
    for (std::size_t i = 0; i < 3; ++i) {
      if (dot(cross(t[(i + 1) % 3] - t[i], at - t[i]), n) < 0) return false;
    }
    return true;
  };
  int found = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle a{point(), point(), point()}, b{point(), point(), point()};
    bool expected = false;
    for (std::size_t k = 0; k < 3; ++k) {
      expected |= pierces(a[k], a[(k + 1) % 3], b) || pierces(b[k], b[(k + 1) % 3], a);
    }
    const auto sides = [](const Triangle& plane, const Triangle& t) {
      const auto of = [&](const Vec3& p) {
        return dot(cross(plane[1] - plane[0], plane[2] - plane[0]), p - plane[0]) > 0 ? 1 : -1;
      };
      return Sides{of(t[0]), of(t[1]), of(t[2])};
    };
    ASSERT_EQ(pass_through(a, b, sides(a, b), sides(b, a)), expected) << i;
    found += expected;
  }
  EXPECT_GT(found, 1000);
}

}  // namespace
}  // namespace tenon
