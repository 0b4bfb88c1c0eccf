#include "lang/builtin_functions.h"

namespace tenon::lang {

Value BuiltinCall::refuse(const std::string& why) const {
  environment.warn(at, std::string(name) + "() " + why + "; its value is undef");
  return {};
}

bool BuiltinCall::has_arguments(std::size_t least, std::size_t most) const {
  if (arguments.size() >= least && arguments.size() <= most) return true;
  std::string wanted = std::to_string(least);
  if (most != least) wanted += " to " + std::to_string(most);
  refuse("takes " + wanted + (most == 1 ? " argument" : " arguments") + ", not " + std::to_string(arguments.size()));
  return false;
}

const double* BuiltinCall::number(std::size_t index) const {
  const double* value = arguments[index].number();
  if (!value) refuse("takes a number, not a value of type " + std::string(arguments[index].type_name()));
  return value;
}

namespace {

template <bool (*test)(const Value&)>
Value type_test(const BuiltinCall& call) {
  return call.has_arguments(1, 1) ? Value(test(call.arguments[0])) : Value();
}

bool is_number(const Value& v) {
  return v.number() && *v.number() == *v.number();
}
bool is_boolean(const Value& v) {
  return v.boolean() != nullptr;
}
bool is_string(const Value& v) {
  return v.string() != nullptr;
}
bool is_list(const Value& v) {
  return v.list() != nullptr;
}
bool is_function(const Value& v) {
  return v.closure() != nullptr;
}

// The version of OpenSCAD whose language this is.
Value version(const BuiltinCall& call) {
  return make_list({2021, 1, 0}, call.environment.budget);
}

Value version_num(const BuiltinCall& call) {
  if (call.arguments.empty()) return Value(20210100.0);
  const List* list = call.arguments[0].list();
  if (!list || list->items().size() < 2 || list->items().size() > 3) return {};
  double number = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double* part = i < list->items().size() ? list->items()[i].number() : nullptr;
    if (i < list->items().size() && !part) return {};
    number = number * 100 + (part ? *part : 0);
  }
  return Value(number);
}

Value parent_module(const BuiltinCall& call) {
  const std::vector<Symbol>& stack = call.environment.module_stack;
  double up = 1;
  if (!call.arguments.empty()) {
    if (!call.arguments[0].number()) return {};
    up = *call.arguments[0].number();
  }
  if (!(up >= 0) || up >= static_cast<double>(stack.size())) {
    return call.refuse("goes further up than the " + std::to_string(stack.size()) + " modules around it");
  }
  return make_string(call.environment.text(stack[stack.size() - 1 - static_cast<std::size_t>(up)]),
                     call.environment.budget);
}

}  // namespace

BuiltinFunctionTable builtin_functions(SymbolTable& symbols) {
  BuiltinFunctionTable table{
      {symbols.intern("is_num"), type_test<is_number>},
      {symbols.intern("is_bool"), type_test<is_boolean>},
      {symbols.intern("is_string"), type_test<is_string>},
      {symbols.intern("is_list"), type_test<is_list>},
      {symbols.intern("is_function"), type_test<is_function>},
      {symbols.intern("version"), version},
      {symbols.intern("version_num"), version_num},
      {symbols.intern("parent_module"), parent_module},
  };
  add_math_functions(table, symbols);
  add_list_functions(table, symbols);
  add_string_functions(table, symbols);
  add_search_functions(table, symbols);
  add_drawing_functions(table, symbols);
  return table;
}

}  // namespace tenon::lang
