#pragma once

#include "lang/ast.h"
#include "lang/environment.h"

namespace tenon::lang {

/// `&&` and `||` do not come here: they may not evaluate their right side.
Value apply(BinaryOperator op, const Value& left, const Value& right, Place at, Environment& environment);
Value apply(UnaryOperator op, const Value& operand, Place at, Environment& environment);

/// `list[index]`; undef where there is nothing.
Value index_value(const Value& list, const Value& index, Environment& environment);
/// `.x`, `.y`, `.z` of a list and `.begin`, `.step`, `.end` of a range.
Value member_value(const Value& object, std::string_view name);

}  // namespace tenon::lang
