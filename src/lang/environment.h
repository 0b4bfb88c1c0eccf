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
  Place current;                     ///< of the latest call, for what ends an evaluation without a place of its own

  const std::string& text(Symbol symbol) const { return symbols.text(symbol); }
  /// Warns once for each message at each place, so that a loop does not flood the terminal.
  void warn(Place at, const std::string& message);

 private:
  std::unordered_set<std::string> warned_;
};

/// " (did you mean 'x'?)" with the likeliest of the candidates, or nothing.
std::string suggestion(std::string_view wrong, const std::vector<std::string_view>& candidates);

}  // namespace tenon::lang
