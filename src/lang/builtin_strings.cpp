#include <cmath>

#include "lang/builtin_functions.h"
#include "lang/format.h"
#include "lang/loops.h"
#include "lang/utf8.h"

namespace tenon::lang {

namespace {

Value str(const BuiltinCall& call) {
  std::string out;
  for (const Value& argument : call.arguments) {
    out += format_text(argument, call.environment.symbols);
    if (out.size() > Budget::limit) throw BudgetExceeded{"a text is longer than 512 MiB"};
  }
  return make_string(std::move(out), call.environment.budget);
}

// A code point, or those of a list or a range; anything else is no character.
void append_characters(const Value& value, const BuiltinCall& call, std::string& out) {
  if (value.list() || value.range()) {
    iterate(value, call.at, call.environment, [&](const Value& item) { append_characters(item, call, out); });
  } else if (const double* code = value.number(); code && *code >= 1 && *code <= 0x10FFFF) {
    append_utf8(static_cast<std::uint32_t>(*code), out);
  }
}

Value chr(const BuiltinCall& call) {
  std::string out;
  for (const Value& argument : call.arguments) append_characters(argument, call, out);
  return make_string(std::move(out), call.environment.budget);
}

Value ord(const BuiltinCall& call) {
  if (!call.has_arguments(1, 1)) return {};
  const String* string = call.arguments[0].string();
  if (!string) return call.refuse("takes a string, not a value of type " + std::string(call.arguments[0].type_name()));
  if (string->text().empty()) return {};
  std::string_view text = string->text();
  return Value(static_cast<double>(take_code_point(text)));
}

}  // namespace

void add_string_functions(BuiltinFunctionTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("str"), str);
  table.emplace(symbols.intern("chr"), chr);
  table.emplace(symbols.intern("ord"), ord);
}

}  // namespace tenon::lang
