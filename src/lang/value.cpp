#include "lang/value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "lang/scope.h"
#include "lang/utf8.h"

namespace tenon::lang {

String::String(std::string text, Budget& budget)
    : text_(std::move(text)), length_(count_code_points(text_)), charge_(budget) {
  charge_.add(sizeof(String) + text_.size());
}

std::string_view String::at(std::size_t index) const {
  std::size_t i = index;
  if (length_ != text_.size()) {
    i = 0;
    for (; index > 0; --index) i += utf8_length(text_[i]);
  }
  return std::string_view(text_).substr(i, utf8_length(text_[i]));
}

List::List(std::vector<Value> items, int depth, Charge charge)
    : items_(std::move(items)), depth_(depth), charge_(std::move(charge)) {}

double Range::size() const {
  const double infinity = std::numeric_limits<double>::infinity();
  if (std::isnan(begin) || std::isnan(step) || std::isnan(end)) return 0;
  if (step == 0) return begin <= end ? infinity : 0;
  const double steps = (end - begin) / step;
  if (std::isnan(steps) || steps < 0) return 0;
  // [0 : 0.1 : 1] has eleven numbers although ten rounded steps may pass the end: the quotient of a difference that a
  // few roundings made counts as whole when it lies within those roundings (1/2, 1/10, ... are themselves rounded).
  const double rounding = 4 * std::numeric_limits<double>::epsilon() * (std::fabs(steps) + 1);
  return std::floor(steps + rounding) + 1;
}

Closure::Closure(const FunctionDefinition* definition_, Ref<Scope> scope_)
    : definition(definition_), scope(std::move(scope_)) {}
Closure::~Closure() = default;

bool Value::truth() const {
  if (const bool* b = boolean()) return *b;
  if (const double* d = number()) return *d != 0;
  if (const String* s = string()) return !s->text().empty();
  if (const List* l = list()) return !l->items().empty();
  return !is_undef();
}

std::string_view Value::type_name() const {
  constexpr std::string_view names[] = {"undefined", "bool", "number", "string", "vector", "range", "function"};
  return names[data_.index()];
}

bool equal(const Value& a, const Value& b) {
  if (a.data_.index() != b.data_.index()) return false;
  if (const double* d = a.number()) return *d == *b.number();
  if (const bool* c = a.boolean()) return *c == *b.boolean();
  if (const String* s = a.string()) return s->text() == b.string()->text();
  if (const Range* r = a.range()) {
    const Range* o = b.range();
    // As the lists of their numbers.
    return r->size() == o->size() && (r->size() == 0 || (r->begin == o->begin && r->step == o->step));
  }
  if (const List* l = a.list()) return std::ranges::equal(l->items(), b.list()->items(), equal);
  if (const Closure* c = a.closure()) return c == b.closure();
  return true;
}

void ListBuilder::add(Value value) {
  if (const List* l = value.list()) {
    depth_ = std::max(depth_, l->depth());
    if (depth_ >= deepest) throw BudgetExceeded{"a list is nested more than 1,000,000 deep"};
  }
  charge_.add(sizeof(Value));
  items_.push_back(std::move(value));
}

Value ListBuilder::finish() && {
  return Value(make_ref<List>(std::move(items_), depth_ + 1, std::move(charge_)));
}

Value make_string(std::string text, Budget& budget) {
  return Value(make_ref<String>(std::move(text), budget));
}

Value make_list(const std::vector<double>& numbers, Budget& budget) {
  ListBuilder list(budget);
  for (double d : numbers) list.add(Value(d));
  return std::move(list).finish();
}

}  // namespace tenon::lang
