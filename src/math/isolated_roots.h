#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "math/root_isolation.h"
#include "math/root_refinement.h"

namespace tenon {

/// The roots that isolation has left room for, each found within its piece and given an interval that holds the exact
/// one. A cluster of roots that cannot be told apart counts as a double root, a pair of crossings at one place, or,
/// where the signs on its sides differ, as a triple one (solve_quadratic says why such a pair is not dropped: another
/// version of the polynomial may tell them apart).
///
/// @param f       as find_bounded_roots wants it
/// @param pieces  of the searched interval
/// @param find_zero  find_zero(f, a, b, value_a, value_b): where f changes its sign (find_sign_change)
/// @param roots   appended to, sorted
template <class F, class FindZero, class Roots>
class IsolatedRoots {
 public:
  IsolatedRoots(const F& f, std::span<const RootPiece> pieces, FindZero find_zero, Roots& roots)
      : f_(f), pieces_(pieces), find_zero_(find_zero), roots_(roots) {}

  /// @return whether f is negative at the beginning
  bool find() {
    // A computed sign decides at the ends of the interval, where no certain one does.
    const auto forced_sign = [this](std::size_t border, double at) {
      const int sign = sign_at(border);
      return sign != 0 ? sign : f_.value(at) < 0 ? -1 : 1;
    };
    const int begin_sign = forced_sign(0, pieces_.front().begin);
    const int end_sign = forced_sign(pieces_.size(), pieces_.back().end);
    std::size_t first = 0;
    int before = begin_sign;
    for (std::size_t i = 0; i < pieces_.size(); ++i) {
      const int after = i + 1 == pieces_.size() ? end_sign : sign_at(i + 1);
      if (after == 0) continue;
      if (pieces_[first].kind != RootPiece::Kind::empty)
        add_roots(pieces_.subspan(first, i + 1 - first), before, after);
      first = i + 1;
      before = after;
    }
    return begin_sign < 0;
  }

 private:
  // The certain sign of f between piece `border` - 1 and the next, or 0.
  int sign_at(std::size_t border) const {
    if (border > 0 && pieces_[border - 1].kind == RootPiece::Kind::empty) return pieces_[border - 1].rising ? 1 : -1;
    if (border < pieces_.size() && pieces_[border].kind == RootPiece::Kind::empty)
      return pieces_[border].rising ? 1 : -1;
    const double at = border < pieces_.size() ? pieces_[border].begin : pieces_.back().end;
    const double value = f_.value(at);
    return std::fabs(value) > f_.error(at) ? (value < 0 ? -1 : 1) : 0;
  }

  // Of pieces between two certain signs, none in between.
  void add_roots(std::span<const RootPiece> group, int before, int after) {
    const double begin = group.front().begin, end = group.back().end;
    // In the pieces at either end that f runs through in the right direction, the sign tells on which side the roots
    // are. What is left in the middle holds the others, wherever they are.
    const auto leads_in = [&](const RootPiece& p) {
      return p.kind == RootPiece::Kind::single && p.rising == (before < 0);
    };
    const auto leads_out = [&](const RootPiece& p) {
      return p.kind == RootPiece::Kind::single && p.rising == (after > 0);
    };
    double core_begin = begin, core_end = end;
    for (std::size_t i = 0; i < group.size() && leads_in(group[i]); ++i) core_begin = group[i].end;
    for (std::size_t i = group.size(); i > 0 && leads_out(group[i - 1]); --i) core_end = group[i - 1].begin;
    if (before != after) {
      const double t = find_zero_(f_, begin, end, before * size_at(begin), after * size_at(end));
      const double least = std::min(t, core_begin), most = std::max(t, core_end);
      if (core_begin >= end) {
        push(t, t, t, begin, end, before < 0, after < 0, before < 0);
      } else if (is_monotone(least, most)) {
        push(t, least, most, begin, end, before < 0, after < 0, before < 0);
      } else {
        for (const bool rising : {before<0, before> 0, before < 0}) {
          push(t, least, most, begin, end, before < 0, after < 0, rising);
        }
      }
    } else if (core_begin < end && core_end > begin) {
      const double t = 0.5 * core_begin + 0.5 * core_end;
      for (const bool rising : {before<0, before> 0}) {
        push(t, std::min(core_begin, core_end), std::max(core_begin, core_end), begin, end, before < 0, after < 0,
             rising);
      }
    }
  }
  bool is_monotone(double begin, double end) const {
    RootPiece piece{begin, end};
    IntervalIsolation(f_).judge(piece, 0.5 * begin + 0.5 * end);
    return piece.kind == RootPiece::Kind::single;
  }
  double size_at(double t) const { return std::max(std::fabs(f_.value(t)), 0x1p-1000); }

  void push(double t, double core_begin, double core_end, double begin, double end, bool negative_before,
            bool negative_after, bool rising) {
    CrossingRoot root;
    root.t = t;
    root.lo = find_certain_place(f_, core_begin, distance_to_certainty(f_, core_begin, end - begin), -1, begin,
                                 negative_before, {});
    root.hi =
        find_certain_place(f_, core_end, distance_to_certainty(f_, core_end, end - begin), 1, end, negative_after, {});
    root.rising = rising;
    roots_.push_back(root);
  }

  const F& f_;
  std::span<const RootPiece> pieces_;
  FindZero find_zero_;
  Roots& roots_;
};

enum class RootIsolation : std::uint8_t { interval, collins };
enum class RootRefinement : std::uint8_t { newton, laguerre, bairstow };

/// All real roots of a polynomial between a and b, by isolation and refinement; solve_polynomial's promise holds.
///
/// @param pieces  overwritten
/// @param roots   overwritten
/// @return whether the polynomial is negative at a
template <int N>
bool solve_by_isolation(const BoundedPolynomial<N>& f, double a, double b, RootIsolation isolation,
                        RootRefinement refinement, RootPieces& pieces, std::vector<CrossingRoot>& roots) {
  pieces.clear();
  roots.clear();
  if (isolation == RootIsolation::interval) {
    IntervalIsolation<N>(f).isolate(a, b, pieces);
  } else {
    CollinsIsolation<N>(f).isolate(a, b, pieces);
  }
  const auto find_zero = [refinement](const auto& g, double from, double to, double value_from, double value_to) {
    switch (refinement) {
      case RootRefinement::laguerre:
        return find_sign_change(g, from, to, value_from, value_to, LaguerreStep<N>{});
      case RootRefinement::bairstow:
        return find_sign_change(g, from, to, value_from, value_to, BairstowStep<N>{});
      case RootRefinement::newton:
        break;
    }
    return find_sign_change(g, from, to, value_from, value_to);
  };
  return IsolatedRoots(f, std::span<const RootPiece>(pieces), find_zero, roots).find();
}

}  // namespace tenon
