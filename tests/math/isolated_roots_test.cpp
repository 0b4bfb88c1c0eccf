#include "math/isolated_roots.h"

#include <acb_poly.h>
#include <gtest/gtest.h>

#include "math/random_polynomials.h"

namespace tenon {
namespace {

struct Method {
  RootIsolation isolation;
  RootRefinement refinement;
};

class EveryMethod : public testing::TestWithParam<Method> {
 public:
  static std::string label(const testing::TestParamInfo<Method>& info) {
    constexpr const char* isolations[] = {"interval", "collins"};
    constexpr const char* refinements[] = {"newton", "laguerre", "bairstow"};
    return std::string(isolations[static_cast<std::size_t>(info.param.isolation)]) + '_' +
           refinements[static_cast<std::size_t>(info.param.refinement)];
  }
  template <int N>
  static std::vector<CrossingRoot> solve(const BoundedPolynomial<N>& f, double a, double b) {
    RootPieces pieces;
    std::vector<CrossingRoot> roots;
    const bool negative = solve_by_isolation(f, a, b, GetParam().isolation, GetParam().refinement, pieces, roots);
    EXPECT_TRUE(roots.empty() || negative == roots.front().rising);
    EXPECT_LT(pieces.size(), most_root_pieces / 4);
    return roots;
  }
};

INSTANTIATE_TEST_SUITE_P(Roots, EveryMethod,
                         testing::Values(Method{RootIsolation::interval, RootRefinement::newton},
                                         Method{RootIsolation::interval, RootRefinement::laguerre},
                                         Method{RootIsolation::interval, RootRefinement::bairstow},
                                         Method{RootIsolation::collins, RootRefinement::newton},
                                         Method{RootIsolation::collins, RootRefinement::laguerre},
                                         Method{RootIsolation::collins, RootRefinement::bairstow}),
                         EveryMethod::label);

TEST_P(EveryMethod, AgreesWith113BitsInEveryDegree) {
  const auto solve_any = [](const auto& f, double a, double b) { return solve(f, a, b); };
  check_random_polynomials<2>(2'000, solve_any);
  check_random_polynomials<4>(2'000, solve_any);
  check_random_polynomials<6>(2'000, solve_any);
  check_random_polynomials<8>(2'000, solve_any);
  check_random_polynomials<12>(1'000, solve_any);
}

// The real roots of an integer polynomial, enclosed by Arb's certified solver; empty where it has multiple ones.
std::vector<double> certified_real_roots(const std::vector<int>& coefficients) {
  std::vector<double> real;
  acb_poly_t p;
  acb_poly_init(p);
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    acb_poly_set_coeff_si(p, static_cast<slong>(i), coefficients[i]);
  }
  const slong degree = acb_poly_degree(p);
  acb_ptr roots = _acb_vec_init(degree);
  for (slong precision = 64; precision <= 1024; precision *= 2) {
    if (acb_poly_find_roots(roots, p, nullptr, 0, precision) < degree) continue;
    if (!acb_poly_validate_real_roots(roots, p, precision)) continue;
    for (slong i = 0; i < degree; ++i) {
      if (arb_contains_zero(acb_imagref(roots + i))) {
        real.push_back(arf_get_d(arb_midref(acb_realref(roots + i)), ARF_RND_NEAR));
      }
    }
    break;
  }
  _acb_vec_clear(roots, degree);
  acb_poly_clear(p);
  std::sort(real.begin(), real.end());
  return real;
}

// Simple roots that are further apart than double's errors: all of them, each in an interval of its own.
TEST_P(EveryMethod, FindsTheRootsThatACertifiedSolverFinds) {
  constexpr int degree = 9;
  Random random(19);
  int found_in_all = 0;
  for (int n = 0; n < 1'000; ++n) {
    std::vector<int> coefficients;
    for (int i = 0; i <= degree; ++i) coefficients.push_back(random.below(2001) - 1000);
    if (coefficients.back() == 0) continue;
    std::vector<double> truth;
    for (const double root : certified_real_roots(coefficients)) {
      if (root > -2 && root < 2) truth.push_back(root);
    }
    Polynomial<degree> p;
    for (std::size_t i = 0; i < p.count; ++i) p.c[i] = coefficients[i];
    const auto found = solve<degree>({p, {}}, -2, 2);
    ASSERT_EQ(found.size(), truth.size()) << n;
    for (std::size_t i = 0; i < truth.size(); ++i) {
      // Arb's root is rounded once.
      const double rounding = 0x1p-52 * std::fabs(truth[i]);
      EXPECT_LE(found[i].lo, truth[i] + rounding);
      EXPECT_GE(found[i].hi, truth[i] - rounding);
      EXPECT_LT(found[i].hi - found[i].lo, 1e-6);
      EXPECT_TRUE(i == 0 || found[i].lo > found[i - 1].hi);
    }
    found_in_all += static_cast<int>(truth.size());
  }
  EXPECT_GT(found_in_all, 1'500);
}

TEST_P(EveryMethod, MultipleRootsAreOneCluster) {
  // (t² - 1/4)² touches zero twice from above; each place counts as a pair or as nothing.
  const auto touching = solve<4>({{{0.0625, 0, -0.5, 0, 1}}, {}}, -1, 1);
  ASSERT_EQ(touching.size(), 4u);
  for (std::size_t i = 0; i < 4; i += 2) {
    EXPECT_EQ(touching[i].lo, touching[i + 1].lo);
    EXPECT_EQ(touching[i].hi, touching[i + 1].hi);
    EXPECT_LT(touching[i].hi - touching[i].lo, 1e-6);
  }
  // (t - 1/3)³ (t + 1/2)², as double has it: one place that is touched, and a triple root.
  const auto mixed = solve<5>(rounded<5>(with_roots<5>({1.0 / 3, 1.0 / 3, 1.0 / 3, -0.5, -0.5})), -1, 1);
  ASSERT_EQ(mixed.size(), 5u);
  EXPECT_LE(mixed[2].lo, 1.0 / 3);
  EXPECT_GE(mixed[2].hi, 1.0 / 3);
  EXPECT_TRUE(mixed[2].rising && !mixed[3].rising && mixed[4].rising);
  EXPECT_LT(mixed[2].hi - mixed[2].lo, 1e-3);
  // Nothing is certain of a zero polynomial, and it ends.
  EXPECT_EQ(solve<4>({}, -1, 1).size() % 2, 0u);
  EXPECT_TRUE(solve<4>({{{1e-3, 0, 0, 0, 1}}, {}}, -1, 1).empty());
}

}  // namespace
}  // namespace tenon
