#include <gtest/gtest.h>

#include "made_up.h"

namespace tenon {
namespace {

using namespace made_up;  // NOLINT(google-build-using-namespace): the vocabulary of these tests
using Times = std::vector<double>;

constexpr double inf = std::numeric_limits<double>::infinity();

TEST(Classifier, FollowsADifference) {
  TreeBuilder b;
  const CsgNodeId a = b.leaf(), tool = b.leaf();
  const CsgTree tree = b.finish(b.subtract({a, tool}));
  const auto runs = runs_of(tree, {{span(1, 5), span(2, 3)}, {}, {}});
  EXPECT_EQ(times_of(runs), (Times{1, 2, 3, 5}));
  EXPECT_EQ(runs[1].surface.leaf, LeafId{1});
  EXPECT_TRUE(runs[1].leaf_entering);
  EXPECT_EQ(runs[1].after, medium_outside);
  EXPECT_EQ(runs[1].owner, LeafId{0}) << "the cut face belongs to the minuend";
}

TEST(Classifier, FlushFacesOfADifferenceLeaveNothing) {
  TreeBuilder b;
  const CsgNodeId a = b.leaf(), tool = b.leaf();
  const CsgTree tree = b.finish(b.subtract({a, tool}));
  // Whichever of the two rounding put first.
  for (const double noise : {-1e-16, 0.0, 1e-16}) {
    EXPECT_EQ(times_of(runs_of(tree, {{span(1, 5, 1e-15, 0), span(1 + noise, 3, 1e-15, 0)}, {}, {}})), (Times{3, 5}));
  }
}

TEST(Classifier, TouchingSolidsShowNoWall) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  for (const double noise : {-1e-16, 0.0, 1e-16}) {
    EXPECT_EQ(times_of(runs_of(tree, {{span(1, 2, 0, 1e-15), span(2 + noise, 3, 1e-15, 0)}, {}, {}})), (Times{1, 3}));
  }
}

TEST(Classifier, AWallJustThickerThanItsBoundStandsAndJustThinnerFalls) {
  TreeBuilder b;
  const CsgTree tree = b.finish(b.leaf());
  constexpr double bound = 0x1p-40;
  const auto wall = [&](double thickness) {
    return times_of(runs_of(tree, {{span(1, 1 + thickness, bound, bound)}, {}, {}}));
  };
  EXPECT_EQ(wall(2 * bound + 0x1p-52), (Times{1, 1 + 2 * bound + 0x1p-52}));
  EXPECT_EQ(wall(2 * bound), Times{}) << "the intervals meet in one point";
}

// Leaf 0 leaves at 2 and leaf 1 enters at 2 + 3 bounds: a gap the bounds keep open. A third crossing in between, whose
// interval meets both, changes nothing in the solid and must not join them.
TEST(Classifier, AnIrrelevantCrossingDoesNotChainTwoFaces) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf(), z = b.leaf(), never = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y, b.intersect({z, never})}));
  const double e = 0x1p-30;
  const Spans irrelevant = {{2 + 1.5 * e, e, 0, true, false}, {9, 0, 1, false, false}};
  const auto t = times_of(runs_of(tree, {{span(1, 2, 0, e), span(2 + 3 * e, 4, e, 0), irrelevant, {}}, {}, {}}));
  EXPECT_EQ(t, (Times{1, 2, 2 + 3 * e, 4}));
}

// Three changes of the root: the second meets the first, the third meets the second alone. It begins its own run.
TEST(Classifier, RootChangesAreGroupedWithTheFirstOnly) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  const double e = 0x1p-30;
  // x: [1, 2], y: [2 + 1.5e, 2 + 3e]; all bounds e. Leave at 2, enter at 2 + 1.5e: one run, nothing happened. Leave at
  // 2 + 3e meets only the second.
  const auto t = times_of(runs_of(tree, {{span(1, 2, 0, e), span(2 + 1.5 * e, 2 + 3 * e, e, e)}, {}, {}}));
  EXPECT_EQ(t, (Times{1, 2 + 3 * e}));
}

TEST(Classifier, TheFirstInTreeOrderShowsWhereFacesCoincide) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  for (const double noise : {-1e-16, 0.0, 1e-16}) {
    const auto runs = runs_of(tree, {{span(1 + noise, 4, 1e-15, 0), span(1, 5, 1e-15, 0)}, {}, {}});
    EXPECT_EQ(times_of(runs).size(), 2u);
    EXPECT_EQ(runs[0].surface.leaf, LeafId{0}) << noise;
    EXPECT_EQ(runs[0].faces.size(), 2u) << "a ray that starts here leaves both faces";
  }
}

TEST(Classifier, InAnIntersectionTheFirstInTreeOrderShowsToo) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.intersect({x, y}));
  for (const double noise : {-1e-16, 0.0, 1e-16}) {
    const auto runs = runs_of(tree, {{span(1 + noise, 4, 1e-15, 0), span(1, 5, 1e-15, 0)}, {}, {}});
    ASSERT_EQ(runs.size(), 2u);
    EXPECT_EQ(runs[0].surface.leaf, LeafId{0}) << noise;
    EXPECT_EQ(runs[1].surface.leaf, LeafId{0});
  }
}

TEST(Classifier, TheOwnerIsTheOneAtTheRunNotWhereTheNextChangeComes) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  const auto runs = runs_of(tree, {{span(2, 4), span(1, 3)}, {}, {}});
  EXPECT_EQ(times_of(runs), (Times{1, 4}));
  EXPECT_EQ(runs[0].owner, LeafId{1});
  EXPECT_EQ(runs[1].owner, LeafId{0});
}

// A cut in the plane where x ends and y begins: what is left there is y alone, however rounding orders the three.
TEST(Classifier, OfTwoSolidsThatTouchInACutTheOneThatIsLeftOwnsIt) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf(), cut = b.leaf();
  const CsgTree tree = b.finish(b.subtract({b.unite({x, y}), cut}));
  const std::vector<double> places{2 - 1e-15, 2, 2 + 1e-15};
  for (const double end : places) {
    for (const double begin : places) {
      for (const double plane : places) {
        const auto away =
            runs_of(tree, {{span(1, end, 0, 1e-14), span(begin, 3, 1e-14), span(0, plane, 0, 1e-14)}, {}, {}});
        ASSERT_EQ(times_of(away).size(), 2u);
        EXPECT_EQ(away[0].owner, LeafId{1});
        EXPECT_EQ(away[0].surface.leaf, LeafId{1});
        const auto behind =
            runs_of(tree, {{span(1, end, 0, 1e-14), span(begin, 3, 1e-14), span(plane, 9, 1e-14)}, {}, {}});
        ASSERT_EQ(times_of(behind).size(), 2u);
        EXPECT_EQ(behind[1].owner, LeafId{0});
        EXPECT_EQ(behind[1].surface.leaf, LeafId{0});
      }
    }
  }
}

// x and y end at 2, where only y matters, for z reaches on. Where y begins again, at 4, x would matter; that is not
// here.
TEST(Classifier, WhatShowsDoesNotDependOnWhereTheRayIsSettled) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), z = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.intersect({b.unite({x, z}), y}));
  Spans twice = span(1, 2);
  for (const Crossing& c : span(4, 5)) twice.push_back(c);
  const Source source{{span(1, 2), span(1, 3), twice}, {}, {}};
  const Expression expression = Expression::compile(tree);
  for (const double limit : {2.5, 3.5, 4.5, inf}) {
    Classifier<ExpressionState, Source> classifier(ExpressionState(expression), source, tree.leaves.size());
    classifier.start();
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) classifier.reveal(LeafId{i});
    ASSERT_TRUE(classifier.settle(limit)) << "the entry at 1";
    const auto run = classifier.settle(limit);
    ASSERT_TRUE(run);
    EXPECT_EQ(run->t, 2);
    EXPECT_EQ(run->surface.leaf, LeafId{2}) << "settled at " << limit;
  }
}

TEST(Classifier, ARayStartsInsideWhatItsStartLiesIn) {
  TreeBuilder b;
  const CsgTree tree = b.finish(b.leaf());
  EXPECT_EQ(times_of(runs_of(tree, {{span(-1, 2)}, {}, {}})), (Times{2}));
  EXPECT_EQ(times_of(runs_of(tree, {{span(-2, -1)}, {}, {}})), (Times{}));
  EXPECT_EQ(times_of(runs_of(tree, {{span(-inf, 2)}, {}, {}})), (Times{2}));
  EXPECT_EQ(times_of(runs_of(tree, {{span(2, inf)}, {}, {}})), (Times{2}));
}

TEST(Classifier, TheStartAbsorbsRootChangesWhoseBoundContainsIt) {
  TreeBuilder b;
  const CsgTree tree = b.finish(b.leaf());
  EXPECT_EQ(times_of(runs_of(tree, {{span(1e-16, 2, 1e-15, 0)}, {}, {}})), (Times{2})) << "it starts inside";
  EXPECT_EQ(times_of(runs_of(tree, {{span(-1, 1e-16, 0, 1e-15)}, {}, {}})), (Times{})) << "it has just left";
  EXPECT_EQ(times_of(runs_of(tree, {{span(2e-15, 2, 1e-15, 0)}, {}, {}})), (Times{2e-15, 2}));
}

// A change that the start does not absorb ends the absorbing, whatever bound comes later.
TEST(Classifier, AbsorbingEndsWithTheFirstChangeThatStandsClear) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  const auto t = times_of(runs_of(tree, {{span(1, 2), span(3, 4, 5, 0)}, {}, {}}));
  EXPECT_EQ(t.front(), 1);
  EXPECT_EQ(t.back(), 4);
}

TEST(Classifier, AnExactZeroIsPassed) {
  TreeBuilder b;
  const CsgTree tree = b.finish(b.leaf());
  EXPECT_EQ(times_of(runs_of(tree, {{span(0, 2)}, {}, {}})), (Times{2}));
  EXPECT_EQ(times_of(runs_of(tree, {{span(-2, 0)}, {}, {}})), (Times{}));
}

TEST(Classifier, ASurfaceShowsOnlyWhereItsBitWouldMatter) {
  TreeBuilder b;
  const CsgNodeId solid = b.leaf(), surface = b.leaf();
  const CsgTree clipped = b.finish(b.intersect({solid, surface}));
  EXPECT_EQ(times_of(runs_of(clipped, {{span(1, 3), probe(2)}, {}, {}})), (Times{2}));
  EXPECT_EQ(times_of(runs_of(clipped, {{span(1, 3), probe(4)}, {}, {}})), (Times{}));

  TreeBuilder b2;
  const CsgNodeId solid2 = b2.leaf(), surface2 = b2.leaf();
  const CsgTree united = b2.finish(b2.unite({solid2, surface2}));
  const auto runs = runs_of(united, {{span(1, 3), probe(4)}, {}, {}});
  EXPECT_EQ(times_of(runs), (Times{1, 3, 4}));
  EXPECT_TRUE(runs[2].is_surface);
  EXPECT_EQ(runs[2].before, runs[2].after) << "a probe, never a flip";
  EXPECT_EQ(times_of(runs_of(united, {{span(1, 3), probe(2)}, {}, {}})), (Times{1, 3})) << "hidden in the solid";
}

TEST(Classifier, TouchingSolidsOfOneMediumShowNoWallAndOfTwoMediaShowOne) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  const std::vector<Spans> spans = {span(1, 2, 0, 1e-15), span(2, 3, 1e-15, 0)};
  EXPECT_EQ(times_of(runs_of(tree, {spans, {7, 7}, {}})), (Times{1, 3}));
  const auto runs = runs_of(tree, {spans, {7, 8}, {}});
  EXPECT_EQ(times_of(runs), (Times{1, 2, 3}));
  EXPECT_EQ(runs[1].before, 7u);
  EXPECT_EQ(runs[1].after, 8u);
}

TEST(Classifier, WhereMediaOverlapTheEarlierWinsUnlessAPriorityIsSet) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  const std::vector<Spans> spans = {span(1, 4), span(2, 6)};
  EXPECT_EQ(times_of(runs_of(tree, {spans, {7, 8}, {}})), (Times{1, 4, 6}));
  EXPECT_EQ(times_of(runs_of(tree, {spans, {7, 8}, {0, 1}})), (Times{1, 2, 6}));
}

TEST(Classifier, ASubtractedLeafIsNoMedium) {
  TreeBuilder b;
  const CsgNodeId glass = b.leaf(), hole = b.leaf(), water = b.leaf();
  // Glass minus a hole, and water poured into the hole: three media along the ray.
  const CsgTree tree = b.finish(b.unite({b.subtract({glass, hole}), water}));
  const double e = 1e-15;
  const auto runs = runs_of(tree, {{span(1, 6), span(2, 4, e, e), span(2, 4, e, e)}, {7, 9, 8}, {}});
  EXPECT_EQ(times_of(runs), (Times{1, 2, 4, 6}));
  EXPECT_EQ(runs[1].before, 7u);
  EXPECT_EQ(runs[1].after, 8u);
  EXPECT_EQ(runs[2].after, 7u);
}

TEST(Classifier, SettlesOnlyRunsThatLieWhollyBeforeTheLimit) {
  TreeBuilder b;
  const CsgTree tree = b.finish(b.leaf());
  const Expression expression = Expression::compile(tree);
  Classifier<ExpressionState, Source> c(ExpressionState(expression), {{span(1, 2, 0.5, 0)}, {}, {}}, 1);
  c.start();
  c.reveal(LeafId{0});
  EXPECT_FALSE(c.settle(1.25)) << "the interval reaches over the limit";
  EXPECT_TRUE(c.run_pending());
  const auto run = c.settle(1.75);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->t, 1);
}

TEST(Classifier, ALeafRevealedLateContributesItsStateAndAFaultIsCounted) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.intersect({x, y}));
  const Expression expression = Expression::compile(tree);
  Classifier<ExpressionState, Source> c(ExpressionState(expression), {{span(1, 9), span(5, 6)}, {}, {}}, 2);
  // x cannot matter before y's enclosure begins at 4, so a structure may reveal it there.
  c.start();
  EXPECT_FALSE(c.settle(4));
  EXPECT_TRUE(c.reveal(LeafId{0}));
  EXPECT_TRUE(c.reveal(LeafId{1}));
  EXPECT_FALSE(c.reveal(LeafId{0})) << "its mailbox knows";
  EXPECT_EQ(c.settle(inf)->t, 5);
  EXPECT_EQ(c.seam_faults(), 0u);
  // Revealed at 5.5 both, the solid appears behind the front.
  c.start();
  EXPECT_FALSE(c.settle(5.5));
  c.reveal(LeafId{0});
  c.reveal(LeafId{1});
  EXPECT_EQ(c.seam_faults(), 1u);
}

TEST(Classifier, NothingIsLeftOfTheRayBefore) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.subtract({x, y}));
  const Expression expression = Expression::compile(tree);
  Classifier<ExpressionState, Source> c(ExpressionState(expression), {{span(1, 5), span(2, 3)}, {}, {}}, 2);
  for (int ray = 0; ray < 3; ++ray) {
    c.start();
    c.reveal(LeafId{0});
    c.reveal(LeafId{1});
    EXPECT_EQ(c.settle(inf)->t, 1);  // and the rest is abandoned, as a first hit does
  }
}

// Against point membership at the middle of every gap between crossings, on random trees and lattice crossings full of
// ties.
TEST(Classifier, AgreesWithPointMembershipOnRandomTrees) {
  std::mt19937_64 rng(20260101);
  for (int round = 0; round < 4000; ++round) {
    TreeBuilder b;
    const int n = 1 + static_cast<int>(rng() % 12);
    const CsgNodeId root = random_subtree(b, rng, n);
    const CsgTree tree = b.finish(root);
    Source source;
    for (int i = 0; i < n; ++i) {
      Spans spans;
      double t = -3;
      for (int k = static_cast<int>(rng() % 3); k > 0; --k) {
        const double in = t + static_cast<double>(1 + rng() % 4), out = in + static_cast<double>(1 + rng() % 4);
        const Spans s = span(in, out);
        spans.insert(spans.end(), s.begin(), s.end());
        t = out;
      }
      source.by_leaf.push_back(spans);
    }
    std::vector<bool> value_after_half;  // membership at 0.5, 1.5, ...
    std::vector<double> expected;
    bool before = false;
    for (int step = 0; step < 30; ++step) {
      std::vector<bool> inside(static_cast<std::size_t>(n), false);
      for (std::size_t i = 0; i < inside.size(); ++i) {
        for (const Crossing& c : source.by_leaf[i]) {
          if (c.t < step + 0.5) inside[i] = !inside[i];
        }
      }
      const bool now = holds(tree, root, inside);
      if (step > 0 && now != before) expected.push_back(step);
      before = now;
    }
    ASSERT_EQ(times_of(runs_of(tree, source)), expected) << "round " << round;
  }
}

// Leaf 1 is subtracted from a leaf that the ray meets later: where it coincides with a face that shows, it is nobody's
// business, however far the ray has gone when the run is judged.
TEST(Classifier, ARunIsJudgedInTheStateRightBehindIt) {
  TreeBuilder b;
  const CsgNodeId far = b.leaf(), tool = b.leaf(), near = b.leaf();
  const CsgTree tree = b.finish(b.complement(b.unite({b.subtract({far, tool}), near})));
  // Before the root changes again at 8, `far` has begun at 3, where `near` hides it.
  const auto runs = runs_of(tree, {{span(3, 8), span(1, 2), span(1, 4)}, {}, {}});
  ASSERT_EQ(times_of(runs), (Times{1, 8}));
  EXPECT_EQ(runs[0].surface.leaf, LeafId{2});
  ASSERT_EQ(runs[0].faces.size(), 1u) << "the face of the tool does not matter here";
  EXPECT_EQ(runs[0].faces[0].leaf, LeafId{2});
}

// A run that ends before the limit, but whose interval meets that of a crossing behind it, has to wait.
TEST(Classifier, ARunWaitsForACrossingBehindTheLimitThatMeetsIt) {
  TreeBuilder b;
  const CsgNodeId x = b.leaf(), y = b.leaf();
  const CsgTree tree = b.finish(b.unite({x, y}));
  const Source source{{span(1, 2), span(2.5, 4, 0.6, 0)}, {}, {}};
  const Expression expression = Expression::compile(tree);
  Classifier<ExpressionState, Source> classifier(ExpressionState(expression), source, tree.leaves.size());
  classifier.start();
  classifier.reveal(LeafId{0});
  classifier.reveal(LeafId{1});
  const auto first = classifier.settle(2.2);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->t, 1);
  EXPECT_FALSE(classifier.settle(2.2)) << "the gap from 2 to 2.5 may be none";
  const auto second = classifier.settle(inf);
  ASSERT_TRUE(second);
  EXPECT_EQ(second->t, 4);
}

// The runs when leaves are revealed as late as a structure may, and the ray settled step by step.
std::vector<Run> runs_step_by_step(const CsgTree& tree, const Source& source, std::mt19937_64& rng) {
  const Expression expression = Expression::compile(tree);
  Classifier<ExpressionState, Source> classifier(ExpressionState(expression), source, tree.leaves.size());
  classifier.start();
  std::vector<Run> runs;
  const auto real = [&](double most) { return most * static_cast<double>(rng() >> 11) * 0x1p-53; };
  for (double limit = 0; limit < 11;) {
    limit += real(1.0);
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
      const Spans& crossings = source.by_leaf[i];
      const auto begins = [limit](const Crossing& c) { return c.t - c.bound < limit; };
      if (std::any_of(crossings.begin(), crossings.end(), begins)) classifier.reveal(LeafId{i});
    }
    while (auto run = classifier.settle(limit)) runs.push_back(*run);
  }
  while (auto run = classifier.settle(inf)) runs.push_back(*run);
  EXPECT_EQ(classifier.seam_faults(), 0u);
  return runs;
}

TEST(Classifier, StepsAlongTheRayChangeNothing) {
  for (unsigned seed = 0; seed < 3000; ++seed) {
    std::mt19937_64 rng(seed);
    const int count = 2 + static_cast<int>(rng() % 9);
    TreeBuilder b;
    const CsgTree tree = b.finish(random_subtree(b, rng, count));
    Source source;
    // Times on a grid, so that many coincide, and bounds that reach to neighbours on it.
    const auto grid = [&](unsigned n, double step) { return step * static_cast<double>(rng() % n); };
    for (int i = 0; i < count; ++i) {
      const double t = grid(18, 0.5), length = 0.5 + grid(6, 0.5);
      source.by_leaf.push_back(span(t, t + length, grid(4, 0.2), grid(4, 0.2)));
    }
    if (seed % 2 == 1) {
      for (int i = 0; i < count; ++i) source.media.push_back(1 + static_cast<MediumId>(rng() % 3));
    }
    const auto whole = runs_of(tree, source), steps = runs_step_by_step(tree, source, rng);
    ASSERT_EQ(times_of(whole), times_of(steps)) << "seed " << seed;
    for (std::size_t i = 0; i < whole.size(); ++i) {
      EXPECT_EQ(whole[i].surface, steps[i].surface) << "seed " << seed;
      EXPECT_EQ(whole[i].owner, steps[i].owner) << "seed " << seed;
      EXPECT_EQ(whole[i].after, steps[i].after) << "seed " << seed;
      EXPECT_EQ(whole[i].faces.size(), steps[i].faces.size()) << "seed " << seed;
    }
  }
}

}  // namespace
}  // namespace tenon
