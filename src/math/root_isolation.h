#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/polynomial.h"
#include "tenon/math/rounding.h"

/// Root isolation (course, "Root isolation methods"): an interval is cut in halves until each part has no root, or one
/// that can be told from all others. Both methods here mind that the polynomial is known to within errors, so what they
/// say holds for the exact one.
namespace tenon {

/// A part of the searched interval, and what is certain of the exact polynomial there.
struct RootPiece {
  enum class Kind : std::uint8_t {
    empty,    ///< it has no root, and the sign of `rising`: positive if true
    single,   ///< it has at most one root, where the polynomial rises or falls as `rising` says
    unknown,  ///< nothing; it is narrower than the threshold, or smaller there than its own error
  };
  double begin = 0, end = 0;
  Kind kind = Kind::unknown;
  bool rising = false;
};
/// In order, without gaps.
using RootPieces = std::vector<RootPiece>;

/// Narrower than this part of the interval a piece is not cut: there double ends, too.
inline constexpr double isolation_threshold = 0x1p-46;
/// Where this many pieces are not enough, clusters of roots are nowhere certain; what is left stays unknown.
inline constexpr std::size_t most_root_pieces = 2048;

inline void add_piece(const RootPiece& piece, RootPieces& pieces) {
  const bool continues = !pieces.empty() && pieces.back().kind == piece.kind && piece.kind != RootPiece::Kind::single &&
                         (piece.kind == RootPiece::Kind::unknown || pieces.back().rising == piece.rising);
  if (continues) {
    pieces.back().end = piece.end;
  } else {
    pieces.push_back(piece);
  }
}

/// Taylor's coefficients p(x + t) of p(t), by repeated synthetic division.
template <int N>
void shift_polynomial(Polynomial<N>& p, double x) {
  for (std::size_t i = 0; i + 1 < p.count; ++i) {
    for (std::size_t j = p.count - 1; j-- > i;) p.c[j] += x * p.c[j + 1];
  }
}

/// The interval method. f over a part is evaluated in the mean value form, c0 + [-1, 1] Σ |c_k| r^k, with c Taylor's
/// coefficients at its middle and r half its width; if that holds 0, so is f', for where it does not f is monotone.
template <int N>
class IntervalIsolation {
 public:
  explicit IntervalIsolation(const BoundedPolynomial<N>& f) : f_(f) {
    slope_size_ = f.first;
    for (double& c : slope_size_.c) c = std::fabs(c);
    slope_error_ = f.coefficient_error.derivative();
  }

  void isolate(double begin, double end, RootPieces& pieces) const {
    cut(begin, end, isolation_threshold * (end - begin), pieces);
  }

  /// Says what a piece is.
  /// @return whether cutting it would tell nothing more
  bool judge(RootPiece& piece, double middle) const {
    const double r = std::max(piece.end - middle, middle - piece.begin), most = std::fabs(middle) + r;
    Polynomial<N> c = f_.p;
    shift_polynomial(c, middle);
    double spread = 0, slope_spread = 0;
    for (std::size_t k = c.count; k-- > 1;) {
      spread = (spread + std::fabs(c.c[k])) * r;
      if (k > 1) slope_spread = (slope_spread + static_cast<double>(k) * std::fabs(c.c[k])) * r;
    }
    // Each coefficient takes two roundings for each of its N steps, and the sums as many again.
    const double error = f_.coefficient_error.value(most) + gamma(4 * N + 4) * f_.p.size(most);
    if (std::fabs(c.c[0]) > spread + error) {
      piece.kind = RootPiece::Kind::empty;
      piece.rising = c.c[0] > 0;
      return true;
    }
    const double slope_error = slope_error_.value(most) + gamma(4 * N + 4) * slope_size_.value(most);
    if (std::fabs(c.c[1]) > slope_spread + slope_error) {
      piece.kind = RootPiece::Kind::single;
      piece.rising = c.c[1] > 0;
      return true;
    }
    return !(std::fabs(c.c[0]) + spread > error);
  }

 private:
  void cut(double begin, double end, double threshold, RootPieces& pieces) const {
    RootPiece piece{begin, end};
    const double middle = 0.5 * begin + 0.5 * end;
    const bool is_narrow = end - begin <= threshold || !(middle > begin && middle < end);
    if (judge(piece, middle) || is_narrow || pieces.size() > most_root_pieces) return add_piece(piece, pieces);
    cut(begin, middle, threshold, pieces);
    cut(middle, end, threshold, pieces);
  }

  const BoundedPolynomial<N>& f_;
  Polynomial<N - 1> slope_size_, slope_error_;
};

/// Collins's method. The part is mapped to [0, 1]; by Descartes' rule the variations in sign of the coefficients of
/// B*(x) = (x + 1)^n B(1 / (x + 1)) exceed the number of roots in it by an even number, so 0 and 1 say all; else
/// B'(x) = B(x / 2) is its left half, B''(x) = B'(x + 1) its right one. (The paper's 2^n is left out: it is the same
/// polynomial, and would overflow.) As printed the method does not end where a root is a multiple one; here a part ends
/// where its coefficients are no larger than their errors, or at the threshold.
template <int N>
class CollinsIsolation {
 public:
  explicit CollinsIsolation(const BoundedPolynomial<N>& f) : f_(f) {}

  void isolate(double begin, double end, RootPieces& pieces) const {
    const double most = std::max(std::fabs(begin), std::fabs(end)), width = end - begin;
    Polynomial<N> b = f_.p;
    shift_polynomial(b, begin);
    double power = 1;
    for (double& c : b.c) {
      c *= power;
      power *= width;
    }
    // Of the value anywhere in the part: the coefficients' own, and that of the shift and the powers.
    const double error = f_.coefficient_error.value(most) + gamma(5 * N) * f_.p.size(most + width);
    cut(b, error, begin, end, isolation_threshold * width, pieces);
  }

 private:
  using Count = Polynomial<N>;

  static constexpr std::array<double, N + 1> binomials() {
    std::array<double, N + 1> row{1};
    for (std::size_t i = 1; i <= N; ++i) {
      for (std::size_t j = i; j > 0; --j) row[j] += row[j - 1];
    }
    return row;
  }

  static void cut(const Count& b, double error, double begin, double end, double threshold, RootPieces& pieces) {
    RootPiece piece{begin, end};
    const double middle = 0.5 * begin + 0.5 * end;
    const bool is_narrow = end - begin <= threshold || !(middle > begin && middle < end);
    if (judge(piece, b, error) || is_narrow || pieces.size() > most_root_pieces) return add_piece(piece, pieces);

    Count half = b;
    double power = 1;
    for (double& c : half.c) {
      c *= power;
      power *= 0.5;
    }
    cut(half, error, begin, middle, threshold, pieces);
    shift_polynomial(half, 1);
    // Two roundings a step, of nothing larger than the sum of the coefficients.
    cut(half, error + gamma(2 * N) * size(half), middle, end, threshold, pieces);
  }

  static double size(const Count& b) {
    double sum = 0;
    for (const double c : b.c) sum += std::fabs(c);
    return sum;
  }

  // A coefficient of B* is a binomial times one of Bernstein's, which is off by no more than B is.
  static bool judge(RootPiece& piece, const Count& b, double error) {
    constexpr std::array<double, N + 1> binomial = binomials();
    Count star = b;
    std::reverse(star.c.begin(), star.c.end());
    shift_polynomial(star, 1);
    const double slack = error + gamma(2 * N) * size(b);
    int variations = 0;
    bool all_sure = true, any_sure = false, positive = false;
    for (std::size_t i = 0; i < star.count; ++i) {
      const bool sure = std::fabs(star.c[i]) > binomial[i] * slack;
      all_sure = all_sure && sure;
      any_sure = any_sure || sure;
      const bool sign = star.c[i] > 0;
      if (i > 0 && sign != positive) ++variations;
      positive = sign;
    }
    if (!any_sure) return true;
    if (!all_sure || variations > 1) return false;
    // The coefficient of x^n is the value at the part's beginning, the constant one that at its end.
    piece.kind = variations == 0 ? RootPiece::Kind::empty : RootPiece::Kind::single;
    piece.rising = variations == 0 ? positive : !positive;
    return true;
  }

  const BoundedPolynomial<N>& f_;
};

}  // namespace tenon
