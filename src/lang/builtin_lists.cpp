#include <cmath>

#include "lang/builtin_functions.h"

namespace tenon::lang {

namespace {

Value length_of(const BuiltinCall& call) {
  if (!call.has_arguments(1, 1)) return {};
  const Value& value = call.arguments[0];
  if (value.list()) return Value(static_cast<double>(value.list()->items().size()));
  if (value.string()) return Value(static_cast<double>(value.string()->length()));
  return call.refuse("takes a list or a string, not a value of type " + std::string(value.type_name()));
}

Value concat(const BuiltinCall& call) {
  ListBuilder out(call.environment.budget);
  for (const Value& argument : call.arguments) {
    if (!argument.list()) {
      out.add(argument);
      continue;
    }
    for (const Value& item : argument.list()->items()) out.add(item);
  }
  return std::move(out).finish();
}

// The extreme of numbers, or of one list of numbers, strings or lists.
template <bool greatest>
Value extreme(const BuiltinCall& call) {
  if (call.arguments.empty()) return call.refuse("takes at least one argument");
  const bool one_list = call.arguments.size() == 1 && call.arguments[0].list();
  const std::vector<Value>& items = one_list ? call.arguments[0].list()->items() : call.arguments;
  if (items.empty()) return call.refuse("takes numbers, not an empty list");
  if (!one_list || items[0].number()) {
    const double* best = nullptr;
    for (const Value& item : items) {
      if (!item.number()) {
        // Within a list, OpenSCAD lets other types be; it compares the numbers.
        if (one_list) continue;
        return call.refuse("takes numbers, not a value of type " + std::string(item.type_name()));
      }
      if (!best || (greatest ? *item.number() > *best : *item.number() < *best)) best = item.number();
    }
    return Value(*best);
  }
  return items[0];
}

Value norm(const BuiltinCall& call) {
  if (!call.has_arguments(1, 1)) return {};
  const List* list = call.arguments[0].list();
  if (!list) return call.refuse("takes a vector of numbers");
  double sum = 0;
  for (const Value& item : list->items()) {
    if (!item.number()) return call.refuse("takes a vector of numbers");
    sum += *item.number() * *item.number();
  }
  return Value(std::sqrt(sum));
}

Value cross(const BuiltinCall& call) {
  if (!call.has_arguments(2, 2)) return {};
  const List* a = call.arguments[0].list();
  const List* b = call.arguments[1].list();
  if (!a || !b) return call.refuse("takes two vectors");
  const std::size_t n = a->items().size();
  if (n != b->items().size() || (n != 2 && n != 3)) return call.refuse("takes two vectors of two or three numbers");
  double u[3] = {}, v[3] = {};
  for (std::size_t i = 0; i < n; ++i) {
    const double* x = a->items()[i].number();
    const double* y = b->items()[i].number();
    if (!x || !y || !std::isfinite(*x) || !std::isfinite(*y)) return call.refuse("takes vectors of finite numbers");
    u[i] = *x;
    v[i] = *y;
  }
  const double z = u[0] * v[1] - u[1] * v[0];
  if (n == 2) return Value(z);
  return make_list({u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], z}, call.environment.budget);
}

// Linear interpolation in a table of [key, value], held at the ends.
Value lookup(const BuiltinCall& call) {
  if (!call.has_arguments(2, 2)) return {};
  const double* key = call.number(0);
  const List* table = call.arguments[1].list();
  if (!key || !table) return {};
  struct Entry {
    double key, value;
  };
  const Entry* below = nullptr;
  const Entry* above = nullptr;
  Entry low{}, high{};
  for (const Value& item : table->items()) {
    if (!item.list() || item.list()->items().size() < 2) continue;
    const double* k = item.list()->items()[0].number();
    const double* v = item.list()->items()[1].number();
    if (!k || !v) continue;
    if (*k <= *key && (!below || *k > low.key)) low = {*k, *v}, below = &low;
    if (*k >= *key && (!above || *k < high.key)) high = {*k, *v}, above = &high;
  }
  if (!below && !above) return {};
  if (!below) return Value(high.value);
  if (!above || low.key == high.key) return Value(low.value);
  const double share = (*key - low.key) / (high.key - low.key);
  return Value(high.value * share + low.value * (1 - share));
}

}  // namespace

void add_list_functions(BuiltinFunctionTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinFunction> functions[] = {
      {"len", length_of}, {"concat", concat}, {"min", extreme<false>}, {"max", extreme<true>},
      {"norm", norm},     {"cross", cross},   {"lookup", lookup},
  };
  for (const auto& [name, function] : functions) table.emplace(symbols.intern(name), function);
}

}  // namespace tenon::lang
