#pragma once

#include <vector>

#include "lang/symbol.h"
#include "lang/value.h"

namespace tenon::lang {

/// The `$` variables: the latest value set by any call that has not returned. One stack a name, so that a look-up does
/// not depend on how deep the calls are.
class DynamicVariables {
 public:
  void push(Symbol name, Value value) {
    if (name.get() >= stacks_.size()) stacks_.resize(name.get() + 1);
    stacks_[name.get()].push_back(std::move(value));
    pushed_.push_back(name);
  }
  /// Null when no call has set it.
  const Value* find(Symbol name) const {
    if (name.get() >= stacks_.size() || stacks_[name.get()].empty()) return nullptr;
    return &stacks_[name.get()].back();
  }

  std::size_t mark() const { return pushed_.size(); }
  void pop_to(std::size_t mark) {
    while (pushed_.size() > mark) {
      stacks_[pushed_.back().get()].pop_back();
      pushed_.pop_back();
    }
  }

 private:
  std::vector<std::vector<Value>> stacks_;
  std::vector<Symbol> pushed_;
};

/// Forgets at its end what was set since its beginning.
class DynamicFrame {
 public:
  explicit DynamicFrame(DynamicVariables& variables) : variables_(variables), mark_(variables.mark()) {}
  DynamicFrame(const DynamicFrame&) = delete;
  DynamicFrame& operator=(const DynamicFrame&) = delete;
  ~DynamicFrame() { variables_.pop_to(mark_); }

 private:
  DynamicVariables& variables_;
  std::size_t mark_;
};

}  // namespace tenon::lang
