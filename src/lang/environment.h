#pragma once

#include <functional>
#include <random>
#include <string>
#include <unordered_set>
#include <vector>

#include "lang/ast.h"
#include "lang/dynamic_variables.h"
#include "lang/failure.h"
#include "lang/scope.h"
#include "tenon/base/diagnostics.h"

namespace tenon::lang {

/// What every part of an evaluation shares.
struct Environment {
  Environment(SymbolTable& symbols_, Diagnostics& diagnostics_) : symbols(symbols_), diagnostics(diagnostics_) {}

  SymbolTable& symbols;
  Diagnostics& diagnostics;
  Budget budget;  ///< outlives every value below
  ScopeRegistry scopes;
  DynamicVariables dynamics;
  std::vector<Symbol> module_stack;  ///< names of the modules being evaluated, for parent_module()
  std::mt19937 random{0};            ///< a fixed seed: the same scene gives the same solid
  std::size_t calls = 0;             ///< of functions and modules, nested
  Place current;                     ///< of the latest call, for what ends an evaluation without a place of its own

  const std::string& text(Symbol symbol) const { return symbols.text(symbol); }
  /// Warns once for each message at each place, so that a loop does not flood the terminal.
  void warn(Place at, const std::string& message);

 private:
  std::unordered_set<std::string> warned_;
};

/// Counts a nested call for as long as it lasts.
class CallCount {
 public:
  /// More than the deepest scene of the papers needs twice over. What has no end shall end within a second.
  static constexpr std::size_t deepest = 200'000;

  explicit CallCount(std::size_t& calls) : calls_(calls) {}
  CallCount(const CallCount&) = delete;
  CallCount& operator=(const CallCount&) = delete;
  ~CallCount() {
    if (counted_) --calls_;
  }
  /// Further calls in the place of this one are not nested, and not counted.
  void count(Place at) {
    if (counted_) return;
    if (calls_ >= deepest) {
      fail(at,
           "calls are nested more than 200,000 deep; check that the recursion ends, or write a function so that the "
           "call of itself comes last");
    }
    counted_ = true;
    ++calls_;
  }

 private:
  std::size_t& calls_;
  bool counted_ = false;
};

}  // namespace tenon::lang
