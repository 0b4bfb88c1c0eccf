#pragma once

#include <array>
#include <cstddef>

#include "tenon/math/rounding.h"

namespace tenon {

/// A sum of doubles held exactly: its terms do not overlap, and the last is the largest (Shewchuk, "Adaptive Precision
/// Floating-Point Arithmetic and Fast Robust Geometric Predicates", 1997, theorem 10).
/// @tparam capacity  the terms that are added at most
template <std::size_t capacity>
class Expansion {
 public:
  void add(double term) {
    if (term == 0) return;
    double carry = term;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = carry + terms_[i];
      const double slip = sum_error(carry, terms_[i], sum);
      if (slip != 0) terms_[kept++] = slip;
      carry = sum;
    }
    if (carry != 0) terms_[kept++] = carry;
    size_ = kept;
  }
  /// Two terms.
  void add_product(double a, double b) {
    const double product = a * b;
    add(product_error(a, b, product));
    add(product);
  }
  /// Four terms.
  void add_product(double a, double b, double c) {
    const double product = a * b;
    add_product(product_error(a, b, product), c);
    add_product(product, c);
  }
  int sign() const { return size_ == 0 ? 0 : terms_[size_ - 1] > 0 ? 1 : -1; }

 private:
  std::array<double, capacity> terms_;  // those behind size_ are never read
  std::size_t size_ = 0;
};

/// a - b without rounding.
struct Difference {
  double high, low;

  Difference(double a, double b) : high(a - b), low(sum_error(a, -b, high)) {}
};

}  // namespace tenon
