#pragma once

#include <string_view>
#include <unordered_map>
#include <vector>

#include "lang/environment.h"

namespace tenon::lang {

/// A call of a built-in function with its arguments evaluated; names of arguments mean nothing to most.
struct BuiltinCall {
  Environment& environment;
  std::string_view name;
  std::vector<Value> arguments;
  Place at;
  std::vector<Symbol> names;  ///< of the arguments; none for those without

  /// Warns and gives undef.
  Value refuse(const std::string& why) const;
  /// False, with a warning, unless there are between `least` and `most` arguments.
  bool has_arguments(std::size_t least, std::size_t most) const;
  /// The number at an index, or null with a warning.
  const double* number(std::size_t index) const;
};

using BuiltinFunction = Value (*)(const BuiltinCall&);
using BuiltinFunctionTable = std::unordered_map<Symbol, BuiltinFunction>;

/// Every built-in function but `is_undef`, which must not evaluate its argument as others do.
BuiltinFunctionTable builtin_functions(SymbolTable& symbols);

void add_math_functions(BuiltinFunctionTable& table, SymbolTable& symbols);
void add_list_functions(BuiltinFunctionTable& table, SymbolTable& symbols);
void add_string_functions(BuiltinFunctionTable& table, SymbolTable& symbols);
void add_drawing_functions(BuiltinFunctionTable& table, SymbolTable& symbols);
void add_search_functions(BuiltinFunctionTable& table, SymbolTable& symbols);

}  // namespace tenon::lang
