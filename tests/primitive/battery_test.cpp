#include <gtest/gtest.h>

#include <algorithm>

#include "primitive/check_crossings.h"
#include "primitive/next_crossing_checks.h"
#include "primitive/random_solid.h"
#include "tenon/math/rounding.h"

/// What every primitive promises, asked of every kind in the list with random fields. A new kind signs by being there;
/// it needs a definition in oracle.h.
namespace tenon {
namespace {

using exact::Line;
using exact::Quad;
using exact::Vec;

constexpr int rays_per_solid = 200;

class Battery : public EveryKind {
 protected:
  void SetUp() override {
    ASSERT_NE(oracle::Definitions<Quad>::find(kind().name), nullptr)
        << "oracle.h has no definition of " << kind().name << "; add one";
  }

  // Sines in 113 bits take so long that fewer rays must do.
  bool has_dear_definition() const { return kind().name == "twisted_prism"; }

  // The part of a ray around the solid, as middle and half length in t.
  static std::pair<double, double> around(const RandomSolid& solid, const LocalRay& ray) {
    const double a = dot(ray.direction, ray.direction);
    return {dot(solid.bounds.center() - ray.origin, ray.direction) / a, solid.size / std::sqrt(a)};
  }

  // Rays without error, judged with 113 bits.
  std::optional<std::string> judge(const RandomSolid& solid, const LocalRay& ray, const Spans& out, Random& random,
                                   int more) {
    const oracle::Solid<Quad> definition(kind().name, solid.values);
    const auto [middle, span] = around(solid, ray);
    const Line<Quad> line{Vec<Quad>(ray.origin), Vec<Quad>(ray.direction)};
    const auto problem = check_against(definition, line, out, middle, span, random, more);
    if (!problem) return {};
    return *problem + describe(ray.origin, ray.direction) + describe(solid.values);
  }
};

// A million rays, judged with 64 bits; what is in doubt then, with 113.
TEST_P(Battery, CrossingsAgreeWithTheDefinitionOnAMillionRays) {
  Random random(seed());
  for (int n = 0; n < 1'000'000; n += rays_per_solid) {
    const RandomSolid solid(kind(), random);
    const oracle::Solid<long double> definition(kind().name, solid.values);
    Spans out;
    for (int i = 0; i < rays_per_solid; ++i) {
      const LocalRay ray = solid.ray(random);
      out.clear();
      spans(solid.store, solid.id, ray, out);
      const auto [middle, span] = around(solid, ray);
      const Line<long double> line{Vec<long double>(ray.origin), Vec<long double>(ray.direction)};
      if (!check_against(definition, line, out, middle, span, random, 1)) continue;
      const auto problem = judge(solid, ray, out, random, 10);
      ASSERT_FALSE(problem) << *problem;
    }
  }
}

TEST_P(Battery, CrossingsAgreeWithTheDefinitionIn113Bits) {
  Random random(seed() + 1);
  const int rays = has_dear_definition() ? 10'000 : 100'000;
  for (int n = 0; n < rays; n += rays_per_solid) {
    const RandomSolid solid(kind(), random);
    Spans out;
    for (int i = 0; i < rays_per_solid; ++i) {
      const bool grazing = random.chance(0.5);
      const LocalRay ray = grazing ? solid.grazing_ray(random) : solid.ray(random);
      spans(solid.store, solid.id, ray, out = {});
      const auto problem = judge(solid, ray, out, random, 2);
      ASSERT_FALSE(problem) << *problem;
    }
  }
}

/// The kinds that are asked for part of a line in less time than for all of it.
class Windows : public EveryKind {
 public:
  static auto all() {
    std::vector<const PrimitiveKind*> kinds;
    for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
      if (!kind.surface && has_windows(kind)) kinds.push_back(&kind);
    }
    return testing::ValuesIn(kinds);
  }

 private:
  // Some of a kind may be too small.
  static bool has_windows(const PrimitiveKind& kind) {
    Random random(1);
    for (int i = 0; i < 20; ++i) {
      const RandomSolid solid(kind, random);
      if (window_share(solid.store, solid.id) < 1) return true;
    }
    return false;
  }
};

// What is asked in a window alone is what the whole line has there, to the last bit, unless a crossing may lie at an
// end of the window.
TEST_P(Windows, ShowWhatTheWholeLineHas) {
  Random random(seed() + 2);
  int shown = 0, shortened = 0;
  for (int n = 0; n < 200'000; n += rays_per_solid) {
    const RandomSolid solid(kind(), random);
    for (int i = 0; i < rays_per_solid; ++i) {
      LocalRay ray = solid.ray(random);
      Spans whole, some;
      spans(solid.store, solid.id, ray, whole);
      if (random.chance(0.3) && !whole.empty()) {
        const Crossing start = whole[static_cast<std::size_t>(random.below(static_cast<int>(whole.size())))];
        ray.origin = ray.origin + start.t * ray.direction;
        const double error = start.bound * max_component(abs(ray.direction)) + 1e-15 * max_component(abs(ray.origin));
        ray.origin_error = {error, error, error};
        ray.on_face = static_cast<int>(start.face);
        whole.clear();
        spans(solid.store, solid.id, ray, whole);
      }
      const double square = dot(ray.direction, ray.direction);
      const double middle = dot(solid.bounds.center() - ray.origin, ray.direction) / square;
      const double span = solid.size / std::sqrt(square);
      const double about = !whole.empty() && random.chance(0.5)
                               ? whole[static_cast<std::size_t>(random.below(static_cast<int>(whole.size())))].t
                               : middle + random.uniform(-1, 1) * span;
      const double size = random.magnitude(-6, 0) * span;
      LineWindow window{about - random.uniform(0, 1) * size, about + random.uniform(0, 1) * size};
      if (random.chance(0.1)) window.begin = -Box3::inf;
      if (random.chance(0.1)) window.end = Box3::inf;
      const auto is_at_end = [&window](const Crossing& c) {
        return std::fabs(c.t - window.begin) <= c.bound || std::fabs(c.t - window.end) <= c.bound;
      };
      if (std::any_of(whole.begin(), whole.end(), is_at_end)) continue;
      spans_within(solid.store, solid.id, {ray, 0}, window, some);
      const auto where = [&] {
        return " from " + std::to_string(window.begin) + " to " + std::to_string(window.end) + describe(whole) +
               describe(some) + describe(ray.origin, ray.direction) + describe(solid.values);
      };
      ASSERT_FALSE(check_order(some)) << *check_order(some) << where();
      shortened += some.size() < whole.size() || (!some.empty() && !std::isfinite(some.front().t));
      const auto starts_inside = [&window](const Spans& list) {
        return std::count_if(list.begin(), list.end(), [&](const Crossing& c) { return c.t < window.begin; }) % 2 != 0;
      };
      ASSERT_EQ(starts_inside(whole), starts_inside(some)) << where();
      const auto keep_within = [&window](Spans& list) {
        std::erase_if(list, [&](const Crossing& c) { return !(window.begin < c.t && c.t < window.end); });
      };
      keep_within(whole);
      keep_within(some);
      ASSERT_EQ(whole.size(), some.size()) << where();
      for (std::size_t k = 0; k < whole.size(); ++k) {
        ASSERT_EQ(whole[k].entering, some[k].entering) << where();
        ASSERT_EQ(whole[k].face, some[k].face) << where();
        ASSERT_EQ(whole[k].t, some[k].t) << where();
        ASSERT_EQ(whole[k].bound, some[k].bound) << where();
        ++shown;
      }
    }
  }
  EXPECT_GT(shown, 20'000);
  EXPECT_GT(shortened, 2'000);
}

/// The kinds that tell one crossing after another.
class Successions : public EveryKind {
 public:
  static auto all() {
    std::vector<const PrimitiveKind*> kinds;
    for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
      Random random(1);
      if (kind.surface) continue;
      const RandomSolid solid(kind, random);
      if (has_next_crossing(solid.store, solid.id)) kinds.push_back(&kind);
    }
    return testing::ValuesIn(kinds);
  }
};

TEST_P(Successions, ShowWhatTheWholeLineHas) {
  struct Solid {
    const RandomSolid& random_solid;
    void spans(const LocalRay& ray, Spans& out) const { tenon::spans(random_solid.store, random_solid.id, ray, out); }
    NextCrossing next_crossing(const LocalRay& ray, const CrossingSearch& search) const {
      return tenon::next_crossing(random_solid.store, random_solid.id, {ray, 0}, search);
    }
  };
  Random random(seed() + 3);
  NextCrossingChecks checks;
  for (int n = 0; n < 100'000; n += rays_per_solid) {
    const RandomSolid solid(kind(), random);
    for (int i = 0; i < rays_per_solid; ++i) {
      checks.check(Solid{solid}, random.chance(0.2) ? solid.grazing_ray(random) : solid.ray(random), solid.size,
                   random);
      if (HasFatalFailure()) return;
    }
  }
  EXPECT_GT(checks.found, checks.rays / 4);
  EXPECT_GT(checks.from_faces, checks.rays / 10);
  EXPECT_LT(checks.unsure, checks.rays / 4);
}

// The ray is known to within errors; the exact line is any other within them.
TEST_P(Battery, BoundsHoldForEveryLineWithinTheErrors) {
  Random random(seed());
  const int rays = has_dear_definition() ? 4'000 : 20'000;
  for (int n = 0; n < rays; n += rays_per_solid) {
    const RandomSolid solid(kind(), random);
    const oracle::Solid<Quad> definition(kind().name, solid.values);
    Spans out;
    for (int i = 0; i < rays_per_solid; ++i) {
      LocalRay ray = random.chance(0.5) ? solid.grazing_ray(random) : solid.ray(random);
      // Small against the smallest extent: a solid smaller than the error of the ray has no crossings to speak of.
      const Vec3 extent = solid.bounds.size();
      const double smallest = std::min({extent.x, extent.y, extent.z});
      const double error = smallest * random.magnitude(-16, -4);
      const double length_ = length(ray.direction);
      const Vec3 oe = random.in_cube(), de = random.in_cube();
      ray.origin_error = error * abs(oe);
      ray.direction_error = error / solid.size * length_ * abs(de);
      spans(solid.store, solid.id, ray, out = {});
      for (int k = 0; k < 2; ++k) {
        const Vec3 a = random.in_cube(), b = random.in_cube();
        const Vec<Quad> origin = Vec<Quad>(ray.origin) + Vec<Quad>(ray.origin_error * a);
        const Vec<Quad> direction = Vec<Quad>(ray.direction) + Vec<Quad>(ray.direction_error * b);
        const auto [middle, span] = around(solid, ray);
        const auto problem = check_against(definition, {origin, direction}, out, middle, span, random, 2,
                                           {length(ray.origin_error), length(ray.direction_error)});
        ASSERT_FALSE(problem) << *problem << describe(ray.origin, ray.direction)
                              << describe(ray.origin_error, ray.direction_error) << describe(solid.values);
      }
    }
  }
}

// A ray that starts on a face: that crossing is at 0, exactly, and the others are within their bounds.
TEST_P(Battery, RaysThatStartOnAFaceCrossItAtZero) {
  Random random(seed());
  int started = 0;
  std::optional<RandomSolid> solid_;
  for (int n = 0; n < 15'000; ++n) {
    if (n % 20 == 0) solid_.emplace(kind(), random);
    const RandomSolid& solid = *solid_;
    const oracle::Solid<Quad> definition(kind().name, solid.values);
    const LocalRay first = solid.ray(random);
    Spans out;
    spans(solid.store, solid.id, first, out);
    if (out.empty()) continue;
    const Crossing start = out[static_cast<std::size_t>(random.below(static_cast<int>(out.size())))];
    if (!std::isfinite(start.t)) continue;
    const Vec3 computed = first.origin + start.t * first.direction;

    // The exact start: from the computed point to the face, by Newton's method along the gradient.
    Vec<Quad> p(computed);
    const Quad step = Quad(solid.size) * 0x1p-40;
    bool clear = true;
    for (int k = 0; k < 4 && clear; ++k) {
      const Quad value = definition.faces(p)[start.face];
      const Vec<Quad> g = definition.gradient(p, start.face, step);
      clear = dot(g, g) > 0;
      if (clear) p = p - (value / dot(g, g)) * g;
    }
    const Vec3 moved = abs((p - Vec<Quad>(computed)).rounded());
    // Near an edge or a tip, which face is first is a matter of the other face's error: another test's business.
    clear = clear && max_component(moved) < 1e-9 * solid.size;
    const Vec<Quad> normal_here = definition.gradient(p, start.face, step);
    const Quad inward = Quad(1e-6) * Quad(solid.size) / exact::square_root(dot(normal_here, normal_here));
    clear = clear && definition.contains(p - inward * normal_here) && !definition.contains(p + inward * normal_here);
    if (!clear) continue;
    ++started;

    LocalRay ray;
    ray.origin = computed;
    ray.direction = random.magnitude(-3, 3) * random.direction();
    ray.origin_error = moved * (1 + 1e-9);
    ray.on_face = static_cast<int>(start.face);
    spans(solid.store, solid.id, ray, out = {});
    const auto where = [&] { return describe(ray.origin, ray.direction) + describe(solid.values); };
    const double cosine = dot(normalize(normal_here.rounded()), normalize(ray.direction));
    if (std::fabs(cosine) < 1e-3) continue;

    const auto at_start =
        std::find_if(out.begin(), out.end(), [](const Crossing& c) { return c.t == 0 && c.bound == 0; });
    ASSERT_NE(at_start, out.end()) << "no crossing at 0 from face " << start.face << describe(out) << where();
    EXPECT_EQ(at_start->face, start.face) << describe(out) << where();
    EXPECT_EQ(at_start->entering, cosine < 0) << describe(out) << where();
    const auto [middle, span] = around(solid, ray);
    const auto problem = check_against(definition, {p, Vec<Quad>(ray.direction)}, out, middle, span, random, 6,
                                       {length(ray.origin_error), 0, 1e-24});
    ASSERT_FALSE(problem) << *problem << " from face " << start.face << where();
  }
  EXPECT_GT(started, 1'500);
}

TEST_P(Battery, NormalsAreGradients) {
  Random random(seed());
  for (int n = 0; n < 10'000; ++n) {
    const RandomSolid solid(kind(), random);
    const oracle::Solid<Quad> definition(kind().name, solid.values);
    const LocalRay ray = solid.ray(random);
    Spans out;
    spans(solid.store, solid.id, ray, out);
    for (const Crossing& c : out) {
      EXPECT_LT(c.face, face_count(solid.store, solid.id).value_or(Crossing{}.face - 1)) << describe(solid.values);
      if (!std::isfinite(c.t)) continue;
      const Vec3 p = ray.origin + c.t * ray.direction;
      const Vec3 g = definition.gradient(Vec<Quad>(p), c.face, Quad(solid.size) * 0x1p-40).rounded();
      // Where the gradient vanishes (the tip of a cone, the middle of a horn torus) no normal is promised.
      const Vec3 n1 = normalize(g), n2 = normalize(normal(solid.store, solid.id, p, c.face));
      const double bend = length(p) * 1e-12 / solid.size;
      const auto turns_beside = [&](double distance) {
        const Vec<Quad> beside(p + distance * solid.size * n1);
        return length(definition.gradient(beside, c.face, Quad(solid.size) * 0x1p-40).rounded() - g) > 0.1 * length(g);
      };
      const bool at_tip = g == Vec3{} || turns_beside(1e-6) || turns_beside(-1e-6);
      if (at_tip) continue;
      EXPECT_GT(dot(n1, n2), 1 - 1e-9 - bend)
          << "face " << c.face << describe(p, ray.direction) << describe(solid.values);
    }
  }
}

// The largest n·p over the crossings of many rays: never above the support, and near it.
TEST_P(Battery, SupportIsTheLargestExtent) {
  Random random(seed());
  const bool clips = std::any_of(kind().fields.begin(), kind().fields.end(),
                                 [](const FieldInfo& f) { return std::holds_alternative<Box3>(f.fallback); });
  for (int n = 0; n < 20; ++n) {
    const RandomSolid solid(kind(), random);
    std::vector<Vec3> points;
    Spans out;
    for (int i = 0; i < 4'000; ++i) {
      const LocalRay ray = solid.ray(random);
      spans(solid.store, solid.id, ray, out = {});
      for (const Crossing& c : out) {
        if (std::isfinite(c.t)) points.push_back(ray.origin + c.t * ray.direction);
      }
    }
    for (int k = 0; k < 20; ++k) {
      // Directions that see each extent alike.
      const Vec3 e = solid.bounds.size();
      Vec3 direction = random.direction();
      direction = {direction.x / e.x, direction.y / e.y, direction.z / e.z};
      const double s = support(solid.store, solid.id, direction);
      double largest = -std::numeric_limits<double>::infinity();
      for (const Vec3& p : points) largest = std::max(largest, dot(direction, p));
      const double width = dot(abs(direction), e);
      EXPECT_LE(largest, s + 1e-12 * width + 1e-13 * std::fabs(s)) << describe(solid.values);
      // A box that clips is more than what it leaves.
      if (kind().bounded && !clips) {
        EXPECT_GT(largest, s - 0.15 * width) << describe(direction, e) << describe(solid.values);
      }
    }
  }
}

// Rays of no use cross nothing, and nothing breaks.
TEST_P(Battery, RaysThatAreNotRaysCrossNothing) {
  Random random(seed());
  const double bad[] = {std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
                        std::numeric_limits<double>::quiet_NaN()};
  const RandomSolid solid(kind(), random);
  Spans out;
  for (const double b : bad) {
    for (int axis = 0; axis < 3; ++axis) {
      LocalRay ray = solid.ray(random);
      ray.origin[axis] = b;
      spans(solid.store, solid.id, ray, out);
      ray = solid.ray(random);
      ray.direction[axis] = b;
      spans(solid.store, solid.id, ray, out);
    }
  }
  LocalRay ray = solid.ray(random);
  ray.direction = {};
  spans(solid.store, solid.id, ray, out);
  EXPECT_TRUE(out.empty());
  // Numbers at the ends of the range are rays, whatever can be said of them.
  for (const double tiny_or_huge : {1e-320, 1e-200, 1e200, 1e308}) {
    for (int i = 0; i < 100; ++i) {
      ray = solid.ray(random);
      ray.direction = ray.direction * tiny_or_huge;
      spans(solid.store, solid.id, ray, out = {});
      EXPECT_FALSE(check_order(out)) << *check_order(out) << describe(ray.origin, ray.direction);
      ray = solid.ray(random);
      ray.origin = ray.origin * tiny_or_huge;
      spans(solid.store, solid.id, ray, out = {});
      EXPECT_FALSE(check_order(out)) << *check_order(out) << describe(ray.origin, ray.direction);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, Battery, EveryKind::all(), EveryKind::label);
INSTANTIATE_TEST_SUITE_P(Kinds, Windows, Windows::all(), EveryKind::label);
INSTANTIATE_TEST_SUITE_P(Kinds, Successions, Successions::all(), EveryKind::label);

// The battery can fail: a sphere whose bounds are ten times too small, one that is too large by a few units in the last
// place, one whose grazing chords are dropped.
TEST(BatteryControl, WrongPrimitivesAreFound) {
  const auto problems = [](auto&& spoil) {
    Random random(7);
    int found = 0;
    const PrimitiveKind& kind = *PrimitiveStore::find_kind("sphere");
    for (int n = 0; n < 2'000; ++n) {
      const RandomSolid solid(kind, random);
      const oracle::Solid<Quad> definition(kind.name, solid.values);
      const LocalRay ray = solid.ray(random);
      Spans out;
      spans(solid.store, solid.id, ray, out);
      spoil(out);
      found +=
          check_against(definition, {Vec<Quad>(ray.origin), Vec<Quad>(ray.direction)}, out, 0, 1, random, 1) ? 1 : 0;
    }
    return found;
  };
  EXPECT_EQ(problems([](Spans&) {}), 0);
  EXPECT_GT(problems([](Spans& s) {
              for (Crossing& c : s) c.bound *= 0.02;
            }),
            20);
  EXPECT_GT(problems([](Spans& s) {
              for (Crossing& c : s) c.t *= 1 + 0x1p-46;
            }),
            100);
  EXPECT_GT(problems([](Spans& s) {
              if (!s.empty()) s.pop_back();
            }),
            500);
  EXPECT_GT(problems([](Spans& s) { s.clear(); }), 100);
}

}  // namespace
}  // namespace tenon
