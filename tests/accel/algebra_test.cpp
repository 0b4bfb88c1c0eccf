#include <functional>

#include "accel/battery.h"

// What a Boolean algebra of solids promises, on rays; and point membership by the definition of the operations, with an
// implicit function for each kind of primitive. Nothing here is shared with the code it judges.
namespace tenon {
namespace {

using fixtures::Draw;
using fixtures::SceneBuilder;
using fixtures::Tracer;

using Point = std::array<long double, 3>;
using Inside = std::function<bool(const Point&)>;

// A solid built twice: as nodes of a scene, and as a predicate on points.
struct Solid {
  SceneNodeId node;
  Inside inside;
};

class SolidBuilder {
 public:
  explicit SolidBuilder(std::uint64_t seed) : draw(seed) {}

  Solid primitive() {
    const auto size = [&] { return draw.real(0.4, 1.3); };
    const double a = size(), c = size(), d = size();
    switch (draw.below(5)) {
      case 0:
        return {b.sphere(a), [=](const Point& p) { return square(p[0]) + square(p[1]) + square(p[2]) <= a * a; }};
      case 1:
        return {b.cube({a, c, d}), [=](const Point& p) {
                  return p[0] >= 0 && p[0] <= a && p[1] >= 0 && p[1] <= c && p[2] >= 0 && p[2] <= d;
                }};
      case 2:
        return {b.cylinder(a, c),
                [=](const Point& p) { return square(p[0]) + square(p[1]) <= c * c && p[2] >= 0 && p[2] <= a; }};
      case 3:
        return {b.torus(a + 0.3, 0.3), [=](const Point& p) {
                  const long double ring = std::sqrt(square(p[0]) + square(p[1])) - (a + 0.3);
                  return square(ring) + square(p[2]) <= 0.3L * 0.3L;
                }};
      default:
        return {b.primitive("paraboloid", {a, c}),
                [=](const Point& p) { return p[2] <= a && (square(p[0]) + square(p[1])) * a <= p[2] * (c * c); }};
    }
  }

  // Stretched and moved; the predicate undoes it.
  Solid placed() {
    const Solid s = primitive();
    const Vec3 stretch = draw.vector(0.5, 1.5), move = draw.vector(-1, 1);
    return {b.translate(move, b.transform(Affine3::scale(stretch), s.node)), [=](const Point& p) {
              return s.inside({(p[0] - move.x) / stretch.x, (p[1] - move.y) / stretch.y, (p[2] - move.z) / stretch.z});
            }};
  }

  Solid unite(const Solid& x, const Solid& y) {
    return {b.unite({x.node, y.node}), [=](const Point& p) { return x.inside(p) || y.inside(p); }};
  }
  Solid intersect(const Solid& x, const Solid& y) {
    return {b.intersect({x.node, y.node}), [=](const Point& p) { return x.inside(p) && y.inside(p); }};
  }
  Solid subtract(const Solid& x, const Solid& y) {
    return {b.subtract({x.node, y.node}), [=](const Point& p) { return x.inside(p) && !y.inside(p); }};
  }
  Solid complement(const Solid& x) {
    return {b.complement(x.node), [=](const Point& p) { return !x.inside(p); }};
  }

  Solid random(int leaves) {
    if (leaves == 1) return draw.one_in(10) ? complement(placed()) : placed();
    const int left = 1 + draw.below(leaves - 1);
    const Solid x = random(left), y = random(leaves - left);
    const int op = draw.below(3);
    return op == 0 ? unite(x, y) : op == 1 ? subtract(x, y) : intersect(x, y);
  }

  Ray ray() { return {draw.vector(-4, 4), draw.vector(-1, 1)}; }

  Draw draw;
  SceneBuilder b;

 private:
  static long double square(long double x) { return x * x; }
};

bool spans_hold(const std::vector<SolidSpan>& spans, double t) {
  return std::any_of(spans.begin(), spans.end(), [t](const SolidSpan& s) { return s.t_in <= t && t < s.t_out; });
}

TEST(Membership, TheMiddleOfEveryGapIsWhereTheDefinitionSays) {
  std::size_t inside = 0;
  for (std::uint64_t seed = 0; seed < 150; ++seed) {
    SolidBuilder s(seed);
    const Solid solid = s.random(2 + s.draw.below(8));
    std::vector<Ray> rays;
    for (int i = 0; i < 40; ++i) rays.push_back(s.ray());
    const CsgTree tree = s.b.tree(solid.node);
    Tracer tracer(tree);
    for (const Ray& ray : rays) {
      const std::vector<SolidSpan> spans = tracer.all_spans(ray);
      // Every stretch between ends, and many places besides.
      std::vector<double> ends{0};
      for (const SolidSpan& span : spans) ends.insert(ends.end(), {span.t_in, std::min(span.t_out, 1e3)});
      ends.push_back(1e3);
      std::vector<double> places;
      for (std::size_t i = 0; i + 1 < ends.size(); ++i) places.push_back(0.5 * (ends[i] + ends[i + 1]));
      for (int i = 0; i < 30; ++i) places.push_back(s.draw.real(0, 10));
      for (const double t : places) {
        // Beside an end either answer is right: coordinates here are below 2^4 and carry a few roundings.
        if (std::any_of(ends.begin(), ends.end(), [t](double e) { return std::fabs(e - t) <= 0x1p-30; })) continue;
        const Point p{ray.origin.x + static_cast<long double>(t) * ray.direction.x,
                      ray.origin.y + static_cast<long double>(t) * ray.direction.y,
                      ray.origin.z + static_cast<long double>(t) * ray.direction.z};
        ASSERT_EQ(spans_hold(spans, t), solid.inside(p)) << "seed " << seed << ", t " << t;
        inside += solid.inside(p);
      }
    }
  }
  EXPECT_GT(inside, 10000u);
}

// The spans of two solids, each over the same primitives, on random rays.
using Law = std::pair<SceneNodeId, SceneNodeId> (*)(SceneBuilder&, SceneNodeId, SceneNodeId, SceneNodeId);

void expect_law(Law law) {
  std::size_t met = 0;
  for (std::uint64_t seed = 0; seed < 120; ++seed) {
    std::vector<Ray> rays;
    const auto build = [&](bool left) {
      SolidBuilder s(seed);
      const Solid x = s.random(3), y = s.random(3), z = s.random(2);
      const auto sides = law(s.b, x.node, y.node, z.node);
      rays.clear();
      for (int i = 0; i < 60; ++i) rays.push_back(s.ray());
      return s.b.tree(left ? sides.first : sides.second);
    };
    const CsgTree left_tree = build(true), right_tree = build(false);
    Tracer left(left_tree), right(right_tree);
    for (const Ray& ray : rays) {
      const std::vector<SolidSpan> spans = left.all_spans(ray);
      ASSERT_EQ(spans, right.all_spans(ray)) << "seed " << seed;
      met += !spans.empty();
    }
  }
  EXPECT_GT(met, 100u);
}

TEST(Algebra, DeMorgan) {
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId) {
    return std::pair{b.complement(b.unite({x, y})), b.intersect({b.complement(x), b.complement(y)})};
  });
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId) {
    return std::pair{b.complement(b.intersect({x, y})), b.unite({b.complement(x), b.complement(y)})};
  });
}

TEST(Algebra, ADifferenceIsAnIntersectionWithTheComplement) {
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId z) {
    return std::pair{b.subtract({b.unite({x, z}), y}), b.intersect({b.unite({x, z}), b.complement(y)})};
  });
}

// x, in a scene as large as one that holds y: the tolerance belongs to the scene, and t depends on it within its bound.
SceneNodeId with_nothing_of(SceneBuilder& b, SceneNodeId x, SceneNodeId y) {
  return b.unite({x, b.subtract({y, y})});
}

TEST(Algebra, Absorption) {
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId) {
    return std::pair{b.unite({x, b.intersect({x, y})}), with_nothing_of(b, x, y)};
  });
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId) {
    return std::pair{b.intersect({x, b.unite({x, y})}), with_nothing_of(b, x, y)};
  });
}

TEST(Algebra, Associativity) {
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId z) {
    return std::pair{b.unite({b.unite({x, y}), z}), b.unite({x, b.unite({y, z})})};
  });
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId z) {
    return std::pair{b.subtract({b.subtract({x, y}), z}), b.subtract({x, b.unite({y, z})})};
  });
}

TEST(Algebra, TheOrderOfAUnionDoesNotMatter) {
  expect_law([](SceneBuilder& b, SceneNodeId x, SceneNodeId y, SceneNodeId z) {
    return std::pair{b.unite({x, y, z}), b.unite({z, x, y})};
  });
}

TEST(Algebra, ASolidWithoutItselfIsNothing) {
  for (std::uint64_t seed = 0; seed < 100; ++seed) {
    SolidBuilder s(seed);
    const Solid x = s.random(5);
    const CsgTree tree = s.b.tree(s.b.subtract({x.node, x.node}));
    Tracer tracer(tree);
    for (int i = 0; i < 60; ++i) EXPECT_TRUE(tracer.all_spans(s.ray()).empty()) << "seed " << seed;
  }
}

}  // namespace
}  // namespace tenon
