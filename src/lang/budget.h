#pragma once

#include <cstddef>

namespace tenon::lang {

/// Thrown by Budget; given a place, and so made a Failure, by the evaluator.
struct BudgetExceeded {
  const char* what;
};

/// What the values of one evaluation may take of the memory.
class Budget {
 public:
  /// Lists of 32 million numbers in all; far above any scene, and reached within a second.
  static constexpr std::size_t limit = std::size_t{1} << 29;

  void charge(std::size_t bytes) {
    used_ += bytes;
    if (used_ > limit) throw BudgetExceeded{"lists and strings take more than 512 MiB"};
  }
  void refund(std::size_t bytes) { used_ -= bytes; }

 private:
  std::size_t used_ = 0;
};

/// A part of a budget, given back at its end.
class Charge {
 public:
  explicit Charge(Budget& budget) : budget_(&budget) {}
  Charge(Charge&& other) noexcept : budget_(other.budget_), bytes_(other.bytes_) { other.bytes_ = 0; }
  Charge(const Charge&) = delete;
  Charge& operator=(const Charge&) = delete;
  Charge& operator=(Charge&&) = delete;
  ~Charge() { budget_->refund(bytes_); }

  void add(std::size_t bytes) {
    bytes_ += bytes;  // first, so that the destructor refunds what an exceeded budget has counted
    budget_->charge(bytes);
  }

 private:
  Budget* budget_;
  std::size_t bytes_ = 0;
};

}  // namespace tenon::lang
