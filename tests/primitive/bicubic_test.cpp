#include <gtest/gtest.h>

#include <cmath>

#include "primitive/bezier_patch.h"
#include "primitive/check_crossings.h"
#include "primitive/dispatch.h"
#include "primitive/patch_basis.h"
#include "primitive/patch_resultant.h"
#include "primitive/patch_roots.h"
#include "support/random.h"

// Bicubic patches: every method finds the same crossings, those that the line and the surface have.
namespace tenon {
namespace {

BezierNet<Vec3> random_patch(Random& random, double wildness) {
  BezierNet<Vec3> net;
  for (std::size_t i = 0; i < 16; ++i) {
    const double x = static_cast<double>(i / 4) / 3, y = static_cast<double>(i % 4) / 3;
    const Vec3 jitter = wildness * random.in_cube();
    net[i] = Vec3{x, y, 0} + jitter;
  }
  return net;
}

LocalRay ray_through(const Vec3& p, Random& random) {
  LocalRay ray;
  ray.direction = random.magnitude(-1, 1) * random.direction();
  ray.origin = p - random.uniform(0.5, 2) / length(ray.direction) * ray.direction;
  return ray;
}

std::vector<PatchRoot> roots_of(const BezierNet<Vec3>& net, const LocalRay& ray, PatchMethod method) {
  std::vector<PatchRoot> all, distinct;
  find_patch_roots(net, ray, method, 1e-3, all);
  std::sort(all.begin(), all.end(), [](const PatchRoot& a, const PatchRoot& b) { return a.t < b.t; });
  for (const PatchRoot& root : all) {
    const bool same = !distinct.empty() && distinct.back().hi >= root.lo && distinct.back().against == root.against;
    if (!same) {
      distinct.push_back(root);
    } else {
      distinct.back().hi = std::max(distinct.back().hi, root.hi);
    }
  }
  return distinct;
}

// A line through a place of the patch meets it there, and there t is within its bound.
TEST(PatchRoots, EveryMethodFindsThePlacesThatALineRunsThrough) {
  Random random(1);
  for (const PatchMethod method : {PatchMethod::interval, PatchMethod::resultant, PatchMethod::subdivision}) {
    for (int n = 0; n < 500; ++n) {
      const BezierNet<Vec3> net = random_patch(random, random.chance(0.5) ? 0.2 : 0.6);
      const double u = random.uniform(0, 1), v = random.uniform(0, 1);
      const Vec3 p = evaluate(net, u, v).value;
      const LocalRay ray = ray_through(p, random);
      const double t = dot(p - ray.origin, ray.direction) / dot(ray.direction, ray.direction);
      bool found = false;
      for (const PatchRoot& root : roots_of(net, ray, method)) found |= root.lo - 1e-15 <= t && t <= root.hi + 1e-15;
      EXPECT_TRUE(found) << n << " by method " << static_cast<int>(method);
    }
  }
}

// With 113 bits: at u and v of a root, the line passes the patch within what the bound says.
TEST(PatchRoots, LieOnThePatchWithinTheirBounds) {
  using exact::Quad;
  Random random(2);
  double worst = 0;
  for (int n = 0; n < 1'000; ++n) {
    const BezierNet<Vec3> net = random_patch(random, 0.3);
    const LocalRay ray = ray_through(evaluate(net, random.uniform(0, 1), random.uniform(0, 1)).value, random);
    std::array<Quad, 16> x{}, y{}, z{};
    const exact::Vec<Quad> d(ray.direction), o(ray.origin);
    for (std::size_t i = 0; i < 16; ++i) x[i] = net[i].x, y[i] = net[i].y, z[i] = net[i].z;
    const auto at = [&](Quad u, Quad v) {
      const Quad bu[] = {(1 - u) * (1 - u) * (1 - u), 3 * u * (1 - u) * (1 - u), 3 * u * u * (1 - u), u * u * u};
      const Quad bv[] = {(1 - v) * (1 - v) * (1 - v), 3 * v * (1 - v) * (1 - v), 3 * v * v * (1 - v), v * v * v};
      exact::Vec<Quad> p;
      for (std::size_t i = 0; i < 16; ++i) {
        p = p + (bu[i / 4] * bv[i % 4]) * exact::Vec<Quad>(x[i], y[i], z[i]);
      }
      return p;
    };
    for (const PatchRoot& root : roots_of(net, ray, PatchMethod::interval)) {
      // Newton's method in u, v and t, from the computed root.
      Quad u = root.u, v = root.v, t = root.t;
      for (int step = 0; step < 4; ++step) {
        const Quad h = 0x1p-40;
        const auto p = at(u, v), miss = p - (o + t * d);
        const auto pu = (1 / (2 * h)) * (at(u + h, v) - at(u - h, v)),
                   pv = (1 / (2 * h)) * (at(u, v + h) - at(u, v - h));
        const auto c = [](const exact::Vec<Quad>& a, const exact::Vec<Quad>& b) {
          return exact::Vec<Quad>{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
        };
        const Quad determinant = dot(c(pu, pv), d);
        if (determinant == 0) break;
        u -= dot(miss, c(pv, d)) / determinant;
        v -= dot(miss, c(d, pu)) / determinant;
        t += dot(miss, c(pu, pv)) / determinant;
      }
      const double error = static_cast<double>(exact::absolute(t - Quad(root.t)));
      const double bound = std::max(root.hi - root.t, root.t - root.lo);
      EXPECT_LE(error, bound) << n << " u " << root.u << " v " << root.v;
      worst = std::max(worst, bound * length(ray.direction));
    }
  }
  RecordProperty("worst_bound", std::to_string(worst));
}

// Beside a silhouette Newton's method runs in circles, and where it stands then is no root: each has to lie on the
// line.
TEST(PatchRoots, OfLinesBesideThePatchAreNone) {
  Random random(12);
  // A quarter of a spout: seen along itself by many lines that miss it narrowly.
  const double rows[4][2] = {{1.7, 0.45}, {2.6, 0.35}, {2.3, 0.95}, {2.7, 1.9}};
  BezierNet<Vec3> net;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      const double across[4] = {0, 0.3, 0.3, 0}, along[4] = {0, 0, 0.6, 0.6};
      net[4 * i + j] = {rows[i][0] + along[j] * (i < 2 ? 0.2 : 0.5), across[j] * (i < 3 ? 2 : 1),
                        rows[i][1] - along[j]};
    }
  }
  int roots = 0, wrong = 0;
  for (int n = 0; n < 200'000; ++n) {
    LocalRay ray;
    const Vec3 aim = evaluate(net, random.uniform(0, 1), random.uniform(0, 1)).value + 0.1 * random.in_cube();
    ray.direction = random.direction();
    ray.origin = aim - 8 * ray.direction;
    std::vector<PatchRoot> found;
    find_patch_roots(net, ray, PatchMethod::interval, 1e-3, found);
    for (const PatchRoot& root : found) {
      const Vec3 off = evaluate(net, root.u, root.v).value - (ray.origin + root.t * ray.direction);
      ++roots;
      wrong += length(off) > 1e-9;
    }
  }
  EXPECT_GT(roots, 50'000);
  EXPECT_EQ(wrong, 0);
}

TEST(PatchRoots, MethodsAgree) {
  Random random(3);
  int disagreements = 0, roots = 0;
  for (int n = 0; n < 2'000; ++n) {
    const BezierNet<Vec3> net = random_patch(random, 0.4);
    const LocalRay ray = ray_through(0.5 * Vec3{1, 1, 0} + 0.7 * random.in_cube(), random);
    const auto by_interval = roots_of(net, ray, PatchMethod::interval);
    const auto by_resultant = roots_of(net, ray, PatchMethod::resultant);
    roots += static_cast<int>(by_interval.size());
    bool same = by_interval.size() == by_resultant.size();
    for (std::size_t i = 0; same && i < by_interval.size(); ++i) {
      same = std::fabs(by_interval[i].t - by_resultant[i].t) <= 4 * (by_interval[i].hi - by_interval[i].lo) + 1e-15;
    }
    disagreements += !same;
  }
  EXPECT_GT(roots, 500);
  EXPECT_EQ(disagreements, 0);
}

// What the resultant leaves out is little enough to be of use.
TEST(PatchResultant, LeavesOutMostOfThePatch) {
  Random random(4);
  double left = 0;
  constexpr int count = 200;
  for (int n = 0; n < count; ++n) {
    BezierNet<double> f, g;
    const double u = random.uniform(0, 1), v = random.uniform(0, 1);
    for (std::size_t i = 0; i < 16; ++i) {
      f[i] = static_cast<double>(i / 4) / 3 + 0.3 * random.uniform(-1, 1);
      g[i] = static_cast<double>(i % 4) / 3 + 0.3 * random.uniform(-1, 1);
    }
    const double f0 = evaluate(f, u, v).value, g0 = evaluate(g, u, v).value;
    for (std::size_t i = 0; i < 16; ++i) f[i] -= f0, g[i] -= g0;
    RootPieces pieces;
    isolate_by_resultant(f, g, 1e-15, pieces);
    bool holds = false;
    for (const RootPiece& piece : pieces) {
      if (piece.kind == RootPiece::Kind::empty) continue;
      left += piece.end - piece.begin;
      holds |= piece.begin <= u && u <= piece.end;
    }
    EXPECT_TRUE(holds) << n;
  }
  EXPECT_LT(left / count, 0.4);
}

TEST(PatchBasis, SplinesAreWhatTheirBlendingFunctionsSay) {
  // Uniform cubic B-splines at u: (1 - u)³, 3 u³ - 6 u² + 4, -3 u³ + 3 u² + 3 u + 1 and u³, sixths.
  Random random(5);
  const BezierNet<Vec3> net = random_patch(random, 0.5);
  const BezierNet<Vec3> patch = blended(net, beta_spline(1, 0));
  for (int i = 0; i < 100; ++i) {
    const double u = random.uniform(0, 1), v = random.uniform(0, 1);
    const auto weights = [](double x) {
      return std::array<double, 4>{(1 - x) * (1 - x) * (1 - x) / 6, (3 * x * x * x - 6 * x * x + 4) / 6,
                                   (-3 * x * x * x + 3 * x * x + 3 * x + 1) / 6, x * x * x / 6};
    };
    Vec3 p;
    for (std::size_t k = 0; k < 16; ++k) p += weights(u)[k / 4] * weights(v)[k % 4] * net[k];
    EXPECT_LT(length(p - evaluate(patch, u, v).value), 1e-14);
  }
}

// Barsky's conditions at a joint: equal places, first derivatives in the ratio of the bias, and second ones that differ
// by the tension along the first.
TEST(PatchBasis, BetaSplinesMeetWithBiasAndTension) {
  for (const auto& [bias, tension] : {std::pair{1.0, 0.0}, {2.0, 0.0}, {0.5, 3.0}, {1.0, 10.0}}) {
    const BasisMatrix m = beta_spline(bias, tension);
    const double p[] = {0.3, -1, 2, 0.7, 1.9};
    const auto control = [&](std::size_t first, std::size_t i) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += m[i][k] * p[first + k];
      return sum;
    };
    EXPECT_NEAR(control(0, 3), control(1, 0), 1e-15);
    const double before = 3 * (control(0, 3) - control(0, 2)), after = 3 * (control(1, 1) - control(1, 0));
    EXPECT_NEAR(after, bias * before, 1e-14);
    const double turn_before = 6 * (control(0, 3) - 2 * control(0, 2) + control(0, 1));
    const double turn_after = 6 * (control(1, 2) - 2 * control(1, 1) + control(1, 0));
    EXPECT_NEAR(turn_after, bias * bias * turn_before + tension * before, 1e-13);
  }
}

std::vector<FieldValue> bicubic(ControlNets nets, std::string_view basis, std::string_view method, bool hull) {
  const PrimitiveKind& kind = *PrimitiveStore::find_kind("bicubic");
  std::vector<FieldValue> values;
  for (const FieldInfo& field : kind.fields) values.push_back(field.fallback);
  values[0] = std::move(nets);
  const auto choose = [](FieldValue& value, std::string_view name) {
    auto& choice = std::get<Choice>(value);
    while (choice.name() != name) ++choice.index;
  };
  choose(values[1], basis);
  choose(values[4], method);
  values[7] = hull;
  return values;
}

// A torus of B-spline patches: rows and columns that run around and meet themselves.
ControlNets ring(std::size_t around, std::size_t across) {
  PointLists net;
  for (std::size_t i = 0; i < around + 3; ++i) {
    auto& row = net.emplace_back();
    for (std::size_t j = 0; j < across + 3; ++j) {
      const double a = 6.283185307179586 * static_cast<double>(i % around) / static_cast<double>(around);
      const double b = 6.283185307179586 * static_cast<double>(j % across) / static_cast<double>(across);
      const double r = 2 + 0.8 * std::cos(b);
      row.push_back({r * std::cos(a), r * std::sin(a), 0.8 * std::sin(b)});
    }
  }
  return {net};
}

// Rays through a closed set of patches: in and out in turn, by every method alike but for the polygons' own error.
TEST(Bicubic, AClosedSetIsASolid) {
  const PrimitiveKind& kind = *PrimitiveStore::find_kind("bicubic");
  PrimitiveStore store;
  std::vector<PrimitiveId> solids;
  for (const std::string_view method : {"interval", "resultant", "subdivision", "polygons"}) {
    const auto added = store.add(kind, bicubic(ring(8, 5), "bspline", method, false));
    ASSERT_TRUE(added) << added.error().message;
    solids.push_back(*added);
  }
  Random random(7);
  int crossed = 0, different = 0;
  for (int i = 0; i < 1'000; ++i) {
    LocalRay ray;
    ray.direction = random.direction();
    ray.origin = Vec3{2, 2, 0.7} * random.in_cube() - 4 * ray.direction;
    std::vector<Spans> found;
    for (const PrimitiveId id : solids) spans(store, id, ray, found.emplace_back());
    for (const Spans& out : found) ASSERT_FALSE(check_order(out)) << *check_order(out);
    crossed += static_cast<int>(found[0].size());
    ASSERT_EQ(found[0].size(), found[1].size()) << describe(found[0]) << describe(found[1]);
    for (std::size_t k = 0; k < found[0].size(); ++k) {
      EXPECT_NEAR(found[0][k].t, found[1][k].t, found[0][k].bound + found[1][k].bound);
      const Vec3 p = ray.origin + found[0][k].t * ray.direction;
      const Vec3 n = normal(store, solids[0], p, found[0][k].face);
      EXPECT_EQ(dot(n, ray.direction) < 0, found[0][k].entering) << describe(found[0]);
    }
    for (const std::size_t other : {2, 3}) different += found[other].size() != found[0].size();
  }
  EXPECT_GT(crossed, 1'000);
  // Of the coarser ones some miss a grazing chord.
  EXPECT_LT(different, 40);
}

TEST(Bicubic, StartsOnItsOwnSurface) {
  const PrimitiveKind& kind = *PrimitiveStore::find_kind("bicubic");
  PrimitiveStore store;
  const PrimitiveId id = *store.add(kind, bicubic(ring(8, 5), "bspline", "interval", false));
  Random random(8);
  for (int i = 0; i < 500; ++i) {
    LocalRay ray;
    ray.direction = random.direction();
    ray.origin = Vec3{2, 2, 0.7} * random.in_cube() - 4 * ray.direction;
    Spans out;
    spans(store, id, ray, out);
    if (out.empty()) continue;
    const Crossing first = out.front();
    LocalRay next;
    next.origin = ray.origin + first.t * ray.direction;
    next.direction = random.direction();
    next.origin_error = Vec3{1, 1, 1} * (first.bound + 1e-15);
    next.on_face = static_cast<int>(first.face);
    const double cosine = dot(normalize(normal(store, id, next.origin, first.face)), next.direction);
    if (std::fabs(cosine) < 0.01) continue;
    spans(store, id, next, out = {});
    ASSERT_FALSE(check_order(out)) << *check_order(out);
    const auto start = std::find_if(out.begin(), out.end(), [](const Crossing& c) { return c.t == 0 && c.bound == 0; });
    ASSERT_NE(start, out.end()) << describe(out);
    EXPECT_EQ(start->entering, cosine < 0) << describe(out);
  }
}

// A bump that rays leave upward: whatever the method takes for the surface, none of it lies above where they start.
TEST(Bicubic, RaysThatLeaveABumpMeetNoPartOfIt) {
  const PrimitiveKind& kind = *PrimitiveStore::find_kind("bicubic");
  std::vector<FieldValue> values;
  for (const FieldInfo& field : kind.fields) values.push_back(field.fallback);
  PointLists net(4, std::vector<Vec3>(4));
  for (std::size_t i = 0; i < 16; ++i) {
    const std::size_t x = i % 4, y = i / 4;
    const bool inner = x % 3 != 0 && y % 3 != 0;
    net[y][x] = {static_cast<double>(x), static_cast<double>(y), inner ? 2.0 : 0.0};
  }
  values[0] = ControlNets{net};
  for (std::uint8_t method = 0; method < 3; ++method) {
    Choice choice = std::get<Choice>(kind.fields[4].fallback);
    choice.index = method;
    values[4] = choice;
    PrimitiveStore store;
    const Result<PrimitiveId> id = store.add(kind, values);
    ASSERT_TRUE(id.ok());
    Random random(9);
    int starts = 0, met = 0;
    for (int n = 0; n < 20'000; ++n) {
      const Vec3 aim{random.uniform(0.1, 2.9), random.uniform(0.1, 2.9), 0.5}, down = random.direction();
      LocalRay ray{aim - 10 * down, down, {}, {}, -1};
      Spans out;
      spans(store, *id, ray, out);
      if (out.empty()) continue;
      ray.origin += out.front().t * ray.direction;
      ray.on_face = static_cast<int>(out.front().face);
      const Vec3 normal = normalize(tenon::normal(store, *id, ray.origin, out.front().face));
      ray.direction = normalize(normal.z > 0 ? normal : -normal) + 0.6 * random.in_cube();
      ++starts;
      out.clear();
      spans(store, *id, ray, out);
      // A bump curves back: what is met close by is the start again.
      for (const Crossing& c : out) met += c.t - c.bound > 0 && c.t < 0.02;
    }
    EXPECT_GT(starts, 5'000);
    EXPECT_EQ(met, 0) << choice.name();
  }
}

// The distance of a point from a patch: of the nearest of many places, and by Gauss's and Newton's method from there.
double distance_from(const BezierNet<Vec3>& net, const Vec3& p) {
  constexpr int grid = 48;
  double u = 0, v = 0, best = Box3::inf;
  const auto take = [&](double at_u, double at_v) {
    const double distance = length(evaluate(net, at_u, at_v).value - p);
    if (distance < best) best = distance, u = at_u, v = at_v;
  };
  for (int i = 0; i <= grid; ++i) {
    for (int j = 0; j <= grid; ++j) take(1.0 * i / grid, 1.0 * j / grid);
  }
  for (int step = 0; step < 8; ++step) {
    const auto at = evaluate(net, u, v);
    const Vec3 away = p - at.value;
    const double uu = dot(at.by_u, at.by_u), uv = dot(at.by_u, at.by_v), vv = dot(at.by_v, at.by_v);
    const double du = dot(at.by_u, away), dv = dot(at.by_v, away), determinant = uu * vv - uv * uv;
    if (!(determinant > 0)) break;
    take(std::clamp(u + (vv * du - uv * dv) / determinant, 0.0, 1.0),
         std::clamp(v + (uu * dv - uv * du) / determinant, 0.0, 1.0));
  }
  return best;
}

// How far triangles over a grid of n by n places stand from the patch at most: h²/8 (|S_uu| + 2 |S_uv| + |S_vv|) for
// h = 1 / n (Filip, Magedson, Markot, "Surface algorithms using bounds on derivatives", 1986), the derivatives bounded
// by differences of control points.
double polygon_error(const BezierNet<Vec3>& net, double n) {
  const auto at = [&net](std::size_t i, std::size_t j) { return net[4 * i + j]; };
  double uu = 0, uv = 0, vv = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < 4; ++j) {
      if (i < 2) uu = std::max(uu, 6 * length(at(i, j) - 2.0 * at(i + 1, j) + at(i + 2, j)));
      if (j < 2) vv = std::max(vv, 6 * length(at(i, j) - 2.0 * at(i, j + 1) + at(i, j + 2)));
      if (i < 3 && j < 3) uv = std::max(uv, 9 * length(at(i, j) - at(i + 1, j) - at(i, j + 1) + at(i + 1, j + 1)));
    }
  }
  return (uu + 2 * uv + vv) / (8 * n * n);
}

// Subdivision and polygons promise no more than their size: each place they find is as near to the patch as that says,
// and subdivision finds every place there is.
TEST(Bicubic, SubdivisionAndPolygonsKeepToTheirSize) {
  const PrimitiveKind& kind = *PrimitiveStore::find_kind("bicubic");
  Random random(10);
  int by_parts = 0, by_polygons = 0, crossed = 0;
  double worst_part = 0, worst_polygon = 0;
  for (int n = 0; n < 60; ++n) {
    SCOPED_TRACE(n);
    const BezierNet<Vec3> net = random_patch(random, random.chance(0.5) ? 0.2 : 0.5);
    const double size = random.magnitude(-3, -1), steps = 2 + random.below(30);
    std::vector<FieldValue> values;
    for (const FieldInfo& field : kind.fields) values.push_back(field.fallback);
    PointLists rows(4, std::vector<Vec3>(4));
    for (std::size_t i = 0; i < 16; ++i) rows[i / 4][i % 4] = net[i];
    values[0] = ControlNets{rows};
    Choice method = std::get<Choice>(values[4]);
    method.index = 3;
    values[4] = method;
    values[6] = steps;
    PrimitiveStore store;
    const Result<PrimitiveId> polygons = store.add(kind, values);
    ASSERT_TRUE(polygons.ok());
    for (int i = 0; i < 20; ++i) {
      const LocalRay ray = ray_through(evaluate(net, random.uniform(0, 1), random.uniform(0, 1)).value, random);
      const double speed = length(ray.direction);
      const auto place = [&ray](double t) { return ray.origin + t * ray.direction; };
      std::vector<PatchRoot> parts, exact;
      find_patch_roots(net, ray, PatchMethod::subdivision, size, parts);
      find_patch_roots(net, ray, PatchMethod::interval, size, exact);
      for (const PatchRoot& root : parts) {
        const double distance = distance_from(net, place(root.t)) / (std::sqrt(3) * size);
        EXPECT_LE(distance, 1);
        worst_part = std::max(worst_part, distance);
      }
      for (const PatchRoot& root : exact) {
        const bool is_found = std::any_of(parts.begin(), parts.end(), [&](const PatchRoot& part) {
          return std::fabs(part.t - root.t) * speed <= size * (1 + 1e-9);
        });
        EXPECT_TRUE(is_found) << root.t;
      }
      Spans crossings;
      spans(store, *polygons, ray, crossings);
      for (const Crossing& c : crossings) {
        const double distance = distance_from(net, place(c.t)) / polygon_error(net, steps);
        EXPECT_LE(distance, 1);
        worst_polygon = std::max(worst_polygon, distance);
      }
      by_parts += static_cast<int>(parts.size());
      by_polygons += static_cast<int>(crossings.size());
      crossed += static_cast<int>(exact.size());
    }
  }
  EXPECT_GT(by_parts, 1'000);
  EXPECT_GT(by_polygons, 1'000);
  EXPECT_GT(crossed, 1'000);
  // The bounds are not so wide that they say nothing.
  EXPECT_GT(worst_part, 0.2);
  EXPECT_GT(worst_polygon, 0.2);
  RecordProperty("worst_part", std::to_string(worst_part));
  RecordProperty("worst_polygon", std::to_string(worst_polygon));
}

TEST(Bicubic, WhatIsNoPatchIsRefused) {
  const auto problem = [](ControlNets nets, std::string_view basis, bool hull) {
    PrimitiveStore store;
    const auto added =
        store.add(*PrimitiveStore::find_kind("bicubic"), bicubic(std::move(nets), basis, "interval", hull));
    return added ? std::string() : added.error().message;
  };
  const std::vector<Vec3> row{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(problem({}, "bezier", true), "bicubic without control points shows nothing");
  EXPECT_EQ(problem({{row, row, row}}, "bezier", true).find("net 0 of bicubic has 3 by 4 points"), 0u);
  EXPECT_EQ(problem({{row, row, row, row, row}}, "bezier", true).find("net 0 of bicubic has 5 by 4 points"), 0u);
  EXPECT_EQ(problem({{row, row, row, row}}, "bezier", true), "bicubic has no area");
  EXPECT_EQ(problem({{row, row, row, {{0, 1, 0}}}}, "bezier", true), "net 0 of bicubic has rows of different lengths");
  EXPECT_EQ(problem(ring(5, 4), "bspline", false), "");
  ControlNets open = ring(5, 4);
  open[0].pop_back();
  EXPECT_EQ(problem(open, "bspline", false).find("bicubic makes no solid"), 0u);
  EXPECT_EQ(problem(open, "bspline", true), "");
}

}  // namespace
}  // namespace tenon
