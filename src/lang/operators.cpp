#include "lang/operators.h"

#include <algorithm>
#include <cmath>

#include "lang/products.h"

namespace tenon::lang {

namespace {

using NumberOperation = double (*)(double, double);

// One number of a list or both: silently undef where a member is no number, as in OpenSCAD.
Value scale_list(const Value& value, double factor, NumberOperation op, bool factor_first, Budget& budget) {
  if (const double* d = value.number()) return Value(factor_first ? op(factor, *d) : op(*d, factor));
  const List* list = value.list();
  if (!list) return {};
  ListBuilder out(budget);
  for (const Value& item : list->items()) out.add(scale_list(item, factor, op, factor_first, budget));
  return std::move(out).finish();
}

Value combine_lists(const Value& a, const Value& b, NumberOperation op, Budget& budget) {
  if (a.number() && b.number()) return Value(op(*a.number(), *b.number()));
  const List* left = a.list();
  const List* right = b.list();
  if (!left || !right) return {};
  ListBuilder out(budget);
  const std::size_t n = std::min(left->items().size(), right->items().size());
  for (std::size_t i = 0; i < n; ++i) out.add(combine_lists(left->items()[i], right->items()[i], op, budget));
  return std::move(out).finish();
}

double add(double a, double b) {
  return a + b;
}
double subtract(double a, double b) {
  return a - b;
}
double multiply(double a, double b) {
  return a * b;
}
double divide(double a, double b) {
  return a / b;
}
double modulo(double a, double b) {
  return std::fmod(a, b);
}
double power(double a, double b) {
  return std::pow(a, b);
}

enum class Order { less, equal, greater, unordered, undefined };

Order compare(const Value& a, const Value& b);

template <class T>
Order compare_plain(const T& a, const T& b) {
  return a < b ? Order::less : b < a ? Order::greater : a == b ? Order::equal : Order::unordered;
}

Order compare_lists(const List& a, const List& b) {
  const std::size_t n = std::min(a.items().size(), b.items().size());
  for (std::size_t i = 0; i < n; ++i) {
    const Order order = compare(a.items()[i], b.items()[i]);
    if (order != Order::equal) return order;
  }
  return compare_plain(a.items().size(), b.items().size());
}

Order compare(const Value& a, const Value& b) {
  if (a.number() && b.number()) return compare_plain(*a.number(), *b.number());
  if (a.string() && b.string()) return compare_plain(a.string()->text(), b.string()->text());
  if (a.boolean() && b.boolean()) return compare_plain(*a.boolean(), *b.boolean());
  if (a.list() && b.list()) return compare_lists(*a.list(), *b.list());
  if (a.range() && b.range()) {
    const Range &r = *a.range(), &s = *b.range();
    // As the lists of their numbers.
    if (r.size() == 0 || s.size() == 0) return compare_plain(r.size(), s.size());
    if (const Order o = compare_plain(r.begin, s.begin); o != Order::equal) return o;
    if (const Order o = compare_plain(r.step, s.step); o != Order::equal) return o;
    return compare_plain(r.size(), s.size());
  }
  return Order::undefined;
}

Value undefined_operation(std::string_view op, const Value& a, const Value& b, Place at, Environment& environment) {
  environment.warn(at, "the operation " + std::string(a.type_name()) + ' ' + std::string(op) + ' ' +
                           std::string(b.type_name()) + " is undefined; its value is undef");
  return {};
}

Value compare_values(BinaryOperator op, const Value& a, const Value& b, Place at, Environment& environment) {
  const Order order = compare(a, b);
  if (order == Order::undefined) return undefined_operation(spelling(op), a, b, at, environment);
  switch (op) {
    case BinaryOperator::less:
      return Value(order == Order::less);
    case BinaryOperator::less_equal:
      return Value(order == Order::less || order == Order::equal);
    case BinaryOperator::greater:
      return Value(order == Order::greater);
    default:
      return Value(order == Order::greater || order == Order::equal);
  }
}

Value element_wise(BinaryOperator op, const Value& a, const Value& b, Place at, Environment& environment) {
  const NumberOperation operation = op == BinaryOperator::add ? add : subtract;
  if (a.list() && b.list()) return combine_lists(a, b, operation, environment.budget);
  return undefined_operation(spelling(op), a, b, at, environment);
}

Value apply_to_numbers(BinaryOperator op, double a, double b) {
  switch (op) {
    case BinaryOperator::multiply:
      return Value(a * b);
    case BinaryOperator::divide:
      return Value(a / b);
    case BinaryOperator::modulo:
      return Value(modulo(a, b));
    case BinaryOperator::power:
      return Value(power(a, b));
    case BinaryOperator::add:
      return Value(a + b);
    case BinaryOperator::subtract:
      return Value(a - b);
    case BinaryOperator::less:
      return Value(a < b);
    case BinaryOperator::less_equal:
      return Value(a <= b);
    case BinaryOperator::greater:
      return Value(a > b);
    case BinaryOperator::greater_equal:
      return Value(a >= b);
    case BinaryOperator::equal:
      return Value(a == b);
    default:
      return Value(a != b);
  }
}

}  // namespace

Value apply(BinaryOperator op, const Value& a, const Value& b, Place at, Environment& environment) {
  if (a.number() && b.number()) return apply_to_numbers(op, *a.number(), *b.number());
  switch (op) {
    case BinaryOperator::equal:
      return Value(equal(a, b));
    case BinaryOperator::not_equal:
      return Value(!equal(a, b));
    case BinaryOperator::less:
    case BinaryOperator::less_equal:
    case BinaryOperator::greater:
    case BinaryOperator::greater_equal:
      return compare_values(op, a, b, at, environment);
    case BinaryOperator::add:
    case BinaryOperator::subtract:
      return element_wise(op, a, b, at, environment);
    case BinaryOperator::multiply:
      if (a.list() && b.list()) return multiply_lists(*a.list(), *b.list(), at, environment);
      if (a.list() && b.number()) return scale_list(a, *b.number(), multiply, false, environment.budget);
      if (a.number() && b.list()) return scale_list(b, *a.number(), multiply, true, environment.budget);
      break;
    case BinaryOperator::divide:
      if (a.list() && b.number()) return scale_list(a, *b.number(), divide, false, environment.budget);
      if (a.number() && b.list()) return scale_list(b, *a.number(), divide, true, environment.budget);
      break;
    default:
      break;
  }
  return undefined_operation(spelling(op), a, b, at, environment);
}

Value apply(UnaryOperator op, const Value& operand, Place at, Environment& environment) {
  if (op == UnaryOperator::not_) return Value(!operand.truth());
  if (op == UnaryOperator::plus) return operand;
  if (operand.number()) return Value(-*operand.number());
  if (operand.list()) return scale_list(operand, -1, multiply, true, environment.budget);
  environment.warn(at, "the operation -" + std::string(operand.type_name()) + " is undefined; its value is undef");
  return {};
}

Value index_value(const Value& list, const Value& index, Environment& environment) {
  const double* number = index.number();
  if (!number || !(*number > -1)) return {};
  const double whole = std::trunc(*number);
  const auto below = [&](std::size_t size) { return whole < static_cast<double>(size); };
  const auto i = static_cast<std::size_t>(below(std::size_t{1} << 32) ? whole : 0.0);
  if (const List* l = list.list()) return below(l->items().size()) ? l->items()[i] : Value();
  if (const String* s = list.string()) {
    return below(s->length()) ? make_string(std::string(s->at(i)), environment.budget) : Value();
  }
  if (const Range* r = list.range()) {
    const double members[] = {r->begin, r->step, r->end};
    return below(3) ? Value(members[i]) : Value();
  }
  return {};
}

Value member_value(const Value& object, std::string_view name) {
  if (const List* list = object.list()) {
    const std::size_t axis = name == "x" ? 0 : name == "y" ? 1 : name == "z" ? 2 : list->items().size();
    return axis < list->items().size() ? list->items()[axis] : Value();
  }
  if (const Range* range = object.range()) {
    if (name == "begin") return Value(range->begin);
    if (name == "step") return Value(range->step);
    if (name == "end") return Value(range->end);
  }
  return {};
}

}  // namespace tenon::lang
