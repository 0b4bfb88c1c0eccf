#include <gtest/gtest.h>

#include "primitive/check_crossings.h"
#include "primitive/dispatch.h"

namespace tenon {
namespace {

Spans cross(std::string_view kind, const std::vector<FieldValue>& values, const Vec3& origin, const Vec3& direction,
            int on_face = -1) {
  PrimitiveStore store;
  const auto id = store.add(*PrimitiveStore::find_kind(kind), values);
  EXPECT_TRUE(id);
  Spans out;
  LocalRay ray;
  ray.origin = origin;
  ray.direction = direction;
  ray.on_face = on_face;
  spans(store, *id, ray, out);
  EXPECT_FALSE(check_order(out)) << *check_order(out);
  return out;
}

void expect_chord(const Spans& spans, double enter, double leave) {
  ASSERT_EQ(spans.size(), 2u) << describe(spans);
  EXPECT_NEAR(spans[0].t, enter, spans[0].bound) << describe(spans);
  EXPECT_NEAR(spans[1].t, leave, spans[1].bound) << describe(spans);
  EXPECT_LT(spans[0].bound + spans[1].bound, 1e-13) << describe(spans);
}

// The same where the ray also touches the solid at one of the ends: pairs whose ends count as one may stand there.
void expect_chord_and_touches(Spans spans, double enter, double leave) {
  for (std::size_t i = 0; i + 1 < spans.size();) {
    if (spans[i + 1].t - spans[i].t <= spans[i].bound + spans[i + 1].bound) {
      spans.erase(spans.begin() + static_cast<std::ptrdiff_t>(i), spans.begin() + static_cast<std::ptrdiff_t>(i) + 2);
    } else {
      ++i;
    }
  }
  expect_chord(spans, enter, leave);
}

// None, or one whose ends count as one.
void expect_nothing(const Spans& spans) {
  for (std::size_t i = 0; i + 1 < spans.size(); i += 2) {
    EXPECT_LE(spans[i + 1].t - spans[i].t, spans[i].bound + spans[i + 1].bound) << describe(spans);
  }
}

const std::vector<FieldValue> unit_cube{Vec3{1, 1, 1}, false};

TEST(SpecialRays, AlongAxesInAFaceAndInAnEdgeOfACubeAreInside) {
  expect_chord(cross("cube", unit_cube, {-1, 0.5, 0}, {1, 0, 0}), 1, 2);
  expect_chord(cross("cube", unit_cube, {-1, 1, 0}, {1, 0, 0}), 1, 2);
  expect_chord(cross("cube", unit_cube, {-1, 0.25, 1}, {1, 0.25, 0}), 1, 2);
  expect_nothing(cross("cube", unit_cube, {-1, 0.5, -1e-300}, {1, 0, 0}));
  expect_nothing(cross("cube", unit_cube, {-1, 0.5, std::nextafter(1.0, 2.0)}, {1, 0, 0}));
}

TEST(SpecialRays, ThroughCornersAndEdgesOfACube) {
  expect_chord(cross("cube", unit_cube, {-1, -1, -1}, {1, 1, 1}), 1, 2);
  expect_nothing(cross("cube", unit_cube, {-1, 1, 0.5}, {1, -1, 0}));  // touches the edge x = y = 0
  expect_nothing(cross("cube", unit_cube, {1, 1, -2}, {-1, -1, 2}));   // touches the corner
}

TEST(SpecialRays, FromInsideMeetWhatLiesBehindToo) {
  expect_chord(cross("cube", unit_cube, {0.25, 0.5, 0.5}, {1, 0, 0}), -0.25, 0.75);
  expect_chord(cross("sphere", {2.0}, {0, 0, 0}, {0, 0, 0.5}), -4, 4);
  expect_chord(cross("torus", {2.0, 1.0}, {2, 0, 0}, {0, 0, 1}), -1, 1);
}

TEST(SpecialRays, FromAFaceAnEdgeAndACorner) {
  Spans s = cross("cube", unit_cube, {1, 0.5, 0.5}, {-1, 0, 0}, 1);
  expect_chord(s, 0, 1);
  EXPECT_EQ(s[0].bound, 0);
  s = cross("cube", unit_cube, {1, 0.5, 0.5}, {1, 0, 0}, 1);
  expect_chord(s, -1, 0);
  EXPECT_EQ(s[1].bound, 0);
  s = cross("cube", unit_cube, {1, 1, 0.5}, {-1, -1, 0}, 1);
  expect_chord(s, 0, 1);
  EXPECT_EQ(s[0].t, 0);
  EXPECT_EQ(s[0].face, 1u);
  s = cross("cube", unit_cube, {0, 0, 0}, {1, 1, 1}, 4);
  expect_chord(s, 0, 1);
  EXPECT_EQ(s[0].face, 4u);
  // Sliding along the face it starts on.
  s = cross("cube", unit_cube, {0.5, 0.5, 1}, {1, 0, 0}, 5);
  expect_chord(s, -0.5, 0.5);
}

TEST(SpecialRays, GrazingAPointOfASphereAreNothing) {
  expect_nothing(cross("sphere", {1.0}, {-3, 1, 0}, {1, 0, 0}));
  expect_nothing(cross("sphere", {1.0}, {-3, std::nextafter(1.0, 0.0), 0}, {1, 0, 0}));
  EXPECT_TRUE(cross("sphere", {1.0}, {-3, 1 + 1e-14, 0}, {1, 0, 0}).empty());
  // Starting there, in the tangent plane.
  expect_nothing(cross("sphere", {1.0}, {0, 1, 0}, {1, 0, 0}, 0));
}

TEST(SpecialRays, AlongTheAxisAndTheSideOfACylinder) {
  const std::vector<FieldValue> post{2.0, 1.0, false};
  expect_chord(cross("cylinder", post, {0, 0, -1}, {0, 0, 1}), 1, 3);
  expect_chord(cross("cylinder", post, {1, 0, -1}, {0, 0, 1}), 1, 3);  // in the side
  expect_chord(cross("cylinder", post, {0.5, 0, -1}, {1e-300, 0, 1}), 1, 3);
  EXPECT_TRUE(cross("cylinder", post, {1.001, 0, -1}, {0, 0, 1}).empty());
  expect_chord(cross("cylinder", post, {-3, 0, 2}, {1, 0, 0}), 2, 4);  // in the lid
  expect_nothing(cross("cylinder", post, {-3, 1, 1}, {1, 0, 0}));
  expect_nothing(cross("cylinder", post, {-2, 0, 1}, {1, 0, 1}));  // touches the upper rim
}

TEST(SpecialRays, ThroughTheTipAndAlongTheSideOfACone) {
  const std::vector<FieldValue> cone{1.0, 1.0, 0.0, false};
  expect_chord_and_touches(cross("cone", cone, {0, 0, -1}, {0, 0, 1}), 1, 2);
  expect_nothing(cross("cone", cone, {-1, 0, 1}, {1, 0, 0}));
  expect_chord(cross("cone", cone, {0.25, 0, 2}, {0, 0, -1}), 1.25, 2);
  // Down through the tip, steeper and flatter than the side.
  expect_chord_and_touches(cross("cone", cone, {-0.5, 0, 2}, {0.5, 0, -1}), 1, 2);
  expect_nothing(cross("cone", cone, {-2, 0, 2}, {2, 0, -1}));
  // Along a line of the side, and parallel to one, inside.
  const Spans in_side = cross("cone", cone, {-1, 0, 2}, {1, 0, -1});
  EXPECT_TRUE(in_side.empty() || in_side.size() == 2);
  expect_chord(cross("cone", cone, {-1, 0, 1.5}, {1, 0, -1}), 0.75, 1.5);
}

TEST(SpecialRays, AlongTheAxisOfAParaboloidHasOneRootAtInfinity) {
  const std::vector<FieldValue> dish{1.0, 1.0};
  expect_chord(cross("paraboloid", dish, {0, 0, -1}, {0, 0, 1}), 1, 2);
  expect_chord(cross("paraboloid", dish, {0.5, 0, -1}, {0, 0, 1}), 1.25, 2);
  expect_chord(cross("paraboloid", dish, {0.5, 0, -1}, {1e-200, 0, 1}), 1.25, 2);
  expect_nothing(cross("paraboloid", dish, {-1, 0, 0}, {1, 0, 0}));
  expect_nothing(cross("paraboloid", dish, {1, 0, -1}, {0, 0, 1}));
}

TEST(SpecialRays, AlongTheStraightLinesOfAHyperboloid) {
  // x² + y² = 1 + z² between -1 and 1: the line (1, t, t) lies in it.
  const std::vector<FieldValue> waisted{2.0, std::sqrt(2.0), 1.0};
  const Spans in_side = cross("hyperboloid", waisted, {1, 0, 0}, {0, 1, 1});
  EXPECT_TRUE(in_side.empty() || in_side.size() == 2);
  expect_chord(cross("hyperboloid", waisted, {0.5, 0, 0}, {0, 1, 1}), -1, 1);
  expect_chord(cross("hyperboloid", waisted, {0, 0, -3}, {0, 0, 1}), 2, 4);
  // In through a cap, out through the side, and in again.
  const Spans twice = cross("hyperboloid", waisted, {1.2, 0, -3}, {0, 0, 1});
  ASSERT_EQ(twice.size(), 4u);
  EXPECT_NEAR(twice[1].t, 3 - std::sqrt(0.44), 1e-14);
  EXPECT_NEAR(twice[2].t, 3 + std::sqrt(0.44), 1e-14);
}

TEST(SpecialRays, TouchingATorus) {
  const std::vector<FieldValue> ring{2.0, 0.5};
  expect_nothing(cross("torus", ring, {-5, 0, 0.5}, {1, 0, 0}));     // lies on top: touches twice
  expect_nothing(cross("torus", ring, {2.5, -5, 0}, {0, 1, 0}));     // touches the equator
  expect_nothing(cross("torus", ring, {1.5, 0, -5}, {0, 0, 1}));     // touches the hole
  EXPECT_TRUE(cross("torus", ring, {0, 0, -5}, {0, 0, 1}).empty());  // through the hole
  const Spans four = cross("torus", ring, {-5, 0, 0}, {1, 0, 0});
  ASSERT_EQ(four.size(), 4u);
  EXPECT_NEAR(four[0].t, 2.5, four[0].bound);
  EXPECT_NEAR(four[1].t, 3.5, four[1].bound);
  EXPECT_NEAR(four[2].t, 6.5, four[2].bound);
  EXPECT_NEAR(four[3].t, 7.5, four[3].bound);
  // The inner equator of the hole, across: a chord that is tangent to it in the middle.
  const Spans inner = cross("torus", ring, {1.5, -5, 0}, {0, 1, 0});
  ASSERT_GE(inner.size(), 2u);
  EXPECT_NEAR(inner.front().t, 3, 1e-13);
  EXPECT_NEAR(inner.back().t, 7, 1e-13);
  // A horn torus: along the axis, where two sides touch.
  expect_nothing(cross("torus", {1.0, 1.0}, {0, 0, -3}, {0, 0, 1}));
}

// A slot: its arcs leave its segments smoothly.
const Outline slot{{{{-1, -0.5, 0}, {1, -0.5, 1}, {1, 0.5, 0}, {-1, 0.5, 1}}}};

TEST(SpecialRays, ThroughTheSeamsOfSegmentsAndArcs) {
  const std::vector<FieldValue> prism{slot, 2.0, false, 1.0};
  expect_chord(cross("prism", prism, {1, -3, 1}, {0, 1, 0}), 2.5, 3.5);
  expect_chord(cross("prism", prism, {-1, 3, 1}, {0, -1, 0}), 2.5, 3.5);
  expect_chord(cross("prism", prism, {-3, 0, 1}, {1, 0, 0}), 1.5, 4.5);
  expect_chord(cross("prism", prism, {0, -1.5, 1}, {1, 1, 0}), 1, 1.5);
  expect_nothing(cross("prism", prism, {1.5, -3, 1}, {0, 1, 0}));
}

TEST(SpecialRays, InAWallOfAPrismAreInside) {
  const std::vector<FieldValue> square{Outline{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, 1.0, false, 1.0};
  expect_chord(cross("prism", square, {-1, 0, 0.5}, {1, 0, 0}), 1, 2);
  expect_chord(cross("prism", square, {-1, 1, 0.5}, {1, 0, 0}), 1, 2);
  expect_chord(cross("prism", square, {0, 0, -1}, {0, 0, 1}), 1, 2);    // in an edge
  expect_chord(cross("prism", square, {0.5, 0, -1}, {0, 0, 1}), 1, 2);  // in a wall, upwards
  expect_chord(cross("prism", square, {-1, -1, -1}, {1, 1, 1}), 1, 2);
  expect_nothing(cross("prism", square, {-1, 1, 0.5}, {1, -1, 0}));  // touches an edge
  EXPECT_TRUE(cross("prism", square, {-1, 1.001, 0.5}, {1, 0, 0}).empty());
  // From a wall, across and along it.
  expect_chord(cross("prism", square, {0.5, 0, 0.5}, {0, 1, 0}, 2), 0, 1);
  expect_chord(cross("prism", square, {0.5, 0, 0.5}, {1, 0, 0}, 2), -0.5, 0.5);
}

// Where a line hardly moves over the plane of the outline, it is nearest to a place of it far beyond the caps.
TEST(SpecialRays, AllButAlongTheAxisOfAPrismCrossNoArc) {
  const Outline circle{{{{1, 0, 1}, {-1, 0, 1}}}};
  for (const double scale : {1.0, 0.5, 1.5}) {
    for (const double aside : {1e-9, 1e-13, 1e-16}) {
      SCOPED_TRACE(testing::Message() << "scale " << scale << " aside " << aside);
      const Spans spans = cross("prism", {circle, 1.0, false, scale}, {0.3, 0.2, -0.5}, {aside, -2 * aside, 1});
      expect_chord(spans, 0.5, 1.5);
    }
  }
}

// The line runs along a short wall of a hole, whose plane goes on through all of the solid.
TEST(SpecialRays, InAWallOfATwistedPrismAreInDoubtThereAlone) {
  const Outline outline{{{{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}}, {{0.5, 0, 0}, {1, 0, 0}, {1, 0.25, 0}}}};
  const std::vector<FieldValue> prism{outline, 1.0, false, 90.0, 1.0, 1.0};
  for (const double z : {0.0, 0.25, 0.5, 1.0}) {
    const Vec3 along{cos_degrees(-90 * z), sin_degrees(-90 * z), 0};
    const Spans found = cross("twisted_prism", prism, Vec3{0, 0, z} - 4 * along, along);
    ASSERT_GE(found.size(), 2u);
    EXPECT_NEAR(found.front().t, 2, 1e-12);
    EXPECT_NEAR(found.back().t, 6, 1e-12);
    for (const Crossing& c : found) EXPECT_LT(c.bound, 0.6) << describe(found);
  }
}

TEST(SpecialRays, ThroughHolesTipsAndLoopsThatCross) {
  const Outline ring{{{{2, 0, 1}, {-2, 0, 1}}, {{1, 0, 1}, {-1, 0, 1}}}};
  Spans four = cross("prism", {ring, 1.0, false, 1.0}, {-3, 0, 0.5}, {1, 0, 0});
  ASSERT_EQ(four.size(), 4u) << describe(four);
  EXPECT_NEAR(four[1].t, 2, four[1].bound);
  EXPECT_NEAR(four[2].t, 4, four[2].bound);
  EXPECT_TRUE(cross("prism", {ring, 1.0, false, 1.0}, {0.5, 0, -1}, {0, 0, 1}).empty());
  expect_chord(cross("prism", {ring, 1.0, false, 1.0}, {1.5, 0, -1}, {0, 0, 1}), 1, 2);
  // A pyramid: through its tip, and past it.
  const Outline square{{{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}}};
  expect_chord_and_touches(cross("prism", {square, 1.0, false, 0.0}, {0, 0, -1}, {0, 0, 1}), 1, 2);
  expect_chord(cross("prism", {square, 1.0, false, 0.0}, {-2, 0, 0.5}, {1, 0, 0}), 1.5, 2.5);
  expect_nothing(cross("prism", {square, 1.0, false, 0.0}, {-1, 0, 1}, {1, 0, 0}));
  // A bow: what is enclosed twice is outside, and both halves have their normals outward.
  const Outline bow{{{{-1, -1, 0}, {1, 1, 0}, {1, -1, 0}, {-1, 1, 0}}}};
  Spans halves = cross("prism", {bow, 1.0, false, 1.0}, {-2, 0.25, 0.5}, {1, 0, 0});
  ASSERT_EQ(halves.size(), 4u) << describe(halves);
  EXPECT_NEAR(halves[1].t, 1.75, halves[1].bound);
  EXPECT_NEAR(halves[2].t, 2.25, halves[2].bound);
}

TEST(SpecialRays, OfATurnedCircleAreThoseOfATorus) {
  const std::vector<FieldValue> ring{Outline{{{{2, -0.5, 1}, {2, 0.5, 1}}}}};
  expect_nothing(cross("revolution", ring, {-5, 0, 0.5}, {1, 0, 0}));     // through both seams, touching
  expect_nothing(cross("revolution", ring, {2.5, -5, 0}, {0, 1, 0}));     // touches the equator
  EXPECT_TRUE(cross("revolution", ring, {0, 0, -5}, {0, 0, 1}).empty());  // through the hole
  const Spans four = cross("revolution", ring, {-5, 0, 0}, {1, 0, 0});
  ASSERT_EQ(four.size(), 4u);
  EXPECT_NEAR(four[0].t, 2.5, four[0].bound);
  EXPECT_NEAR(four[1].t, 3.5, four[1].bound);
  EXPECT_NEAR(four[2].t, 6.5, four[2].bound);
  EXPECT_NEAR(four[3].t, 7.5, four[3].bound);
  expect_chord(cross("revolution", ring, {2, 0, -3}, {0, 0, 1}), 2.5, 3.5);  // along the seams
}

TEST(SpecialRays, OfATurnedPolygonThroughItsAxisRimsAndTip) {
  // A cylinder of radius 1 and height 1 with a cone on it.
  const std::vector<FieldValue> pen{Outline{{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 2, 0}}}}};
  expect_chord_and_touches(cross("revolution", pen, {0, 0, -1}, {0, 0, 1}), 1, 3);
  expect_chord(cross("revolution", pen, {0.5, 0, -1}, {0, 0, 1}), 1, 2.5);
  expect_chord(cross("revolution", pen, {-2, 0, 0.5}, {1, 0, 0}), 1, 3);
  expect_chord(cross("revolution", pen, {-2, 0, 1}, {1, 0, 0}), 1, 3);  // through the rim
  expect_nothing(cross("revolution", pen, {-2, 0, 2}, {1, 0, 0}));      // touches the tip
  expect_nothing(cross("revolution", pen, {-2, 1, 0.5}, {1, 0, 0}));    // touches the side
  expect_chord(cross("revolution", pen, {-2, 0, 0}, {1, 0, 0}), 1, 3);  // in the bottom
  expect_chord(cross("revolution", pen, {0.5, 0, 0}, {0, 0, 1}, 0), 0, 1.5);
  expect_chord(cross("revolution", pen, {1, 0, 0.5}, {-1, 0, 0}, 2), 0, 2);
}

TEST(SpecialRays, HalfSpacesCrossAtInfinity) {
  const double inf = std::numeric_limits<double>::infinity();
  const std::vector<FieldValue> below{Vec3{0, 0, 2}, 2.0};
  Spans s = cross("halfspace", below, {0, 0, 3}, {0, 0, -1});
  ASSERT_EQ(s.size(), 2u);
  EXPECT_NEAR(s[0].t, 2, s[0].bound);
  EXPECT_EQ(s[1].t, inf);
  s = cross("halfspace", below, {0, 0, 3}, {0, 0, 1});
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].t, -inf);
  EXPECT_NEAR(s[1].t, -2, s[1].bound);
  s = cross("halfspace", below, {0, 0, 1}, {1, 0, 0});  // in the face
  ASSERT_EQ(s.size(), 2u);
  EXPECT_EQ(s[0].t, -inf);
  EXPECT_EQ(s[1].t, inf);
  EXPECT_TRUE(cross("halfspace", below, {0, 0, 1.5}, {1, 0, 0}).empty());
}

// At unit size and without tolerance a bound is a few units in the last place, over the cosine.
TEST(Bounds, AreAsSmallAsConditioningAllows) {
  struct Case {
    std::string_view kind;
    std::vector<FieldValue> values;
  };
  for (const Case& c :
       {Case{"sphere", {1.0}}, Case{"cube", {Vec3{2, 2, 2}, true}}, Case{"cylinder", {2.0, 1.0, true}},
        Case{"cone", {2.0, 1.0, 0.5, true}}, Case{"torus", {0.75, 0.25}}, Case{"hyperboloid", {2.0, 1.0, 0.5}},
        Case{"paraboloid", {1.0, 1.0}}, Case{"prism", {slot, 1.0, true, 0.5}},
        Case{"revolution", {Outline{{{{0.75, -0.25, 1}, {0.75, 0.25, 1}}}}}}}) {
    Random random(11);
    PrimitiveStore store;
    const PrimitiveId id = *store.add(*PrimitiveStore::find_kind(c.kind), c.values);
    double worst = 0, sum = 0;
    int count = 0;
    for (int i = 0; i < 20'000; ++i) {
      LocalRay ray;
      ray.direction = random.direction();
      ray.origin = 0.5 * random.in_cube() - 0.5 * ray.direction;
      Spans out;
      spans(store, id, ray, out);
      for (const Crossing& crossing : out) {
        const Vec3 p = ray.origin + crossing.t * ray.direction;
        const double cosine = std::fabs(dot(normalize(normal(store, id, p, crossing.face)), ray.direction));
        if (cosine < 0.05) continue;
        worst = std::max(worst, crossing.bound * cosine / unit_roundoff);
        sum += crossing.bound * cosine / unit_roundoff;
        ++count;
      }
    }
    RecordProperty(std::string(c.kind) + "_mean", std::to_string(sum / count));
    RecordProperty(std::string(c.kind) + "_worst", std::to_string(worst));
    const bool simple = c.kind != "torus" && c.kind != "prism" && c.kind != "revolution";
    EXPECT_LT(sum / count, simple ? 20 : c.kind == "revolution" ? 80 : 40) << c.kind;
    EXPECT_LT(worst, simple ? 100 : c.kind == "torus" ? 200 : 400) << c.kind;
    std::printf("[ bounds  ] %-12s mean %5.1f u, worst %5.1f u\n", c.kind.data(), sum / count, worst);
  }
}

}  // namespace
}  // namespace tenon
