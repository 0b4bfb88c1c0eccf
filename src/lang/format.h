#pragma once

#include <string>

#include "lang/ast.h"
#include "lang/value.h"

namespace tenon::lang {

/// A number as `echo` shows it: six significant digits.
std::string format_number(double number);
/// A value as `echo` shows it: strings in quotes.
std::string format_value(const Value& value, const SymbolTable& symbols);
/// A value as `str` shows it: a string without quotes.
std::string format_text(const Value& value, const SymbolTable& symbols);
/// A text in quotes, as a scene has it.
std::string quoted(const std::string& text);
/// An expression as assertions and function values show it.
std::string format_expression(const Expression& expression, const SymbolTable& symbols);
/// `function(parameters) body`.
std::string format_function(const FunctionDefinition& function, const SymbolTable& symbols);

}  // namespace tenon::lang
