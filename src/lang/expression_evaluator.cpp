#include "lang/expression_evaluator.h"

#include <algorithm>

#include "lang/deep_stack.h"
#include "lang/format.h"
#include "lang/operators.h"
#include "tenon/base/suggestion.h"

namespace tenon::lang {

namespace {

// OpenSCAD's own bound on how often a function may call itself without need of the stack.
constexpr std::size_t most_tail_calls = 1'000'000;

}  // namespace

ExpressionEvaluator::ExpressionEvaluator(Environment& environment)
    : environment_(environment),
      builtins_(builtin_functions(environment.symbols)),
      is_undef_(environment.symbols.intern("is_undef")),
      condition_(environment.symbols.intern("condition")),
      message_(environment.symbols.intern("message")) {}

void ExpressionEvaluator::check_depth(Place at) const {
  if (!stack_remains()) {
    fail(at, "this is nested too deep; check that every recursion ends");
  }
}

// A loop instead of a recursion wherever the value of an expression is that of another one in another scope: so a
// function whose last act is a call of itself runs in constant space.
Value ExpressionEvaluator::evaluate(const Expression& start, Scope& start_scope) {
  check_depth(start.at);
  const DynamicFrame frame(environment_.dynamics);
  CallCount count(environment_.calls);
  const Expression* e = &start;
  Scope* scope = &start_scope;
  Ref<Scope> keep;
  for (std::size_t calls = 0;;) {
    if (const auto* number = std::get_if<Number>(&e->node)) return Value(number->value);
    if (const auto* name = std::get_if<Variable>(&e->node)) return variable(*name, e->at, *scope);
    if (const auto* node = std::get_if<Binary>(&e->node)) return binary(*node, e->at, *scope);
    if (const auto* call = std::get_if<Call>(&e->node)) {
      environment_.current = e->at;
      const std::optional<Callee> callee = resolve(*call, e->at, *scope);
      if (!callee) return {};
      if (!callee->function) return builtin_call(*callee, *call, e->at, *scope);
      if (++calls > most_tail_calls) {
        fail(e->at, "a function has called itself 1,000,000 times; check that its recursion ends");
      }
      count.count(e->at);
      const FunctionDefinition& function = *callee->function.definition;
      Ref<Scope> inner = bind_call(function.parameters, call->arguments, *scope, callee->function.scope, nullptr);
      enter_unit(callee->function.used);
      keep = std::move(inner);
      scope = keep.get();
      e = function.body;
    } else if (const auto* choice = std::get_if<Conditional>(&e->node)) {
      e = evaluate(*choice->condition, *scope).truth() ? choice->yes : choice->no;
    } else if (const auto* let = std::get_if<Let>(&e->node)) {
      keep = bind_let(let->bindings, *scope);
      scope = keep.get();
      e = let->body;
    } else if (const auto* check = std::get_if<Assert>(&e->node)) {
      check_assertion(check->arguments, *scope, e->at);
      if (!check->body) return {};
      e = check->body;
    } else if (const auto* echo = std::get_if<Echo>(&e->node)) {
      environment_.diagnostics.say("ECHO: " + echo_line(echo->arguments, *scope));
      if (!echo->body) return {};
      e = echo->body;
    } else if (const auto* literal = std::get_if<ListLiteral>(&e->node)) {
      return list(*literal, *scope);
    } else if (const auto* index = std::get_if<Index>(&e->node)) {
      const Value of = evaluate(*index->list, *scope);
      return index_value(of, evaluate(*index->index, *scope), environment_);
    } else if (const auto* member = std::get_if<Member>(&e->node)) {
      return member_value(evaluate(*member->object, *scope), environment_.text(member->name));
    } else if (const auto* unary = std::get_if<Unary>(&e->node)) {
      return apply(unary->op, evaluate(*unary->operand, *scope), e->at, environment_);
    } else if (const auto* bounds = std::get_if<RangeLiteral>(&e->node)) {
      return range(*bounds, e->at, *scope);
    } else if (const auto* truth = std::get_if<Boolean>(&e->node)) {
      return Value(truth->value);
    } else if (const auto* text = std::get_if<Text>(&e->node)) {
      return make_string(text->value, environment_.budget);
    } else if (const auto* made = std::get_if<FunctionLiteral>(&e->node)) {
      return Value(make_ref<Closure>(made->definition, Ref<Scope>(scope)));
    } else if (std::holds_alternative<Undef>(e->node)) {
      return {};
    } else {
      fail(e->at, "'for', 'if' and 'each' make elements of a list; put square brackets around them");
    }
  }
}

Value ExpressionEvaluator::variable(const Variable& variable, Place at, Scope& scope) {
  const bool special = environment_.symbols.is_special(variable.name);
  const Value* value = special ? environment_.dynamics.find(variable.name) : scope.find(variable.name);
  if (value) return *value;
  environment_.warn(at,
                    "the variable '" + environment_.text(variable.name) + "' is not defined here; its value is undef");
  return {};
}

Value ExpressionEvaluator::binary(const Binary& node, Place at, Scope& scope) {
  const Value left = evaluate(*node.left, scope);
  if (node.op == BinaryOperator::and_) return Value(left.truth() && evaluate(*node.right, scope).truth());
  if (node.op == BinaryOperator::or_) return Value(left.truth() || evaluate(*node.right, scope).truth());
  return apply(node.op, left, evaluate(*node.right, scope), at, environment_);
}

Value ExpressionEvaluator::list(const ListLiteral& literal, Scope& scope) {
  ListBuilder out(environment_.budget);
  for (const Expression* item : literal.elements) element(*item, scope, out);
  return std::move(out).finish();
}

Value ExpressionEvaluator::range(const RangeLiteral& literal, Place at, Scope& scope) {
  const Value begin = evaluate(*literal.begin, scope);
  const Value step = literal.step ? evaluate(*literal.step, scope) : Value(1.0);
  const Value end = evaluate(*literal.end, scope);
  if (!begin.number() || !step.number() || !end.number()) {
    environment_.warn(at, "a range needs numbers, but this one has " + std::string(begin.type_name()) + " : " +
                              std::string(step.type_name()) + " : " + std::string(end.type_name()) +
                              "; its value is undef");
    return {};
  }
  if (!literal.step && *begin.number() > *end.number()) {
    environment_.warn(at, "a range without step counts upwards, from its end to its begin here; write [" +
                              format_number(*begin.number()) + ":-1:" + format_number(*end.number()) +
                              "] to count down");
    return Value(make_ref<Range>(*end.number(), 1.0, *begin.number()));
  }
  return Value(make_ref<Range>(*begin.number(), *step.number(), *end.number()));
}

Value ExpressionEvaluator::builtin_call(const Callee& callee, const Call& call, Place at, Scope& scope) {
  if (callee.is_undef) return test_undef(call, scope);
  const auto& name = std::get<Variable>(call.function->node);
  BuiltinCall evaluated{environment_, environment_.text(name.name), {}, at, {}};
  evaluated.arguments.reserve(call.arguments.size());
  for (const Argument& argument : call.arguments) {
    evaluated.arguments.push_back(evaluate(*argument.value, scope));
    evaluated.names.push_back(argument.name);
  }
  return callee.builtin(evaluated);
}

// Asking whether a variable is defined is no reason for the warning that it is not.
Value ExpressionEvaluator::test_undef(const Call& call, Scope& scope) {
  if (call.arguments.size() != 1) {
    environment_.warn(call.function->at, "is_undef() takes 1 argument; its value is undef");
    return {};
  }
  const Expression& argument = *call.arguments[0].value;
  if (const auto* name = std::get_if<Variable>(&argument.node)) {
    const bool special = environment_.symbols.is_special(name->name);
    const Value* value = special ? environment_.dynamics.find(name->name) : scope.find(name->name);
    return Value(!value || value->is_undef());
  }
  return Value(evaluate(argument, scope).is_undef());
}

// A variable that holds a function goes before a function of that name, wherever either is defined.
std::optional<ExpressionEvaluator::Callee> ExpressionEvaluator::resolve(const Call& call, Place at, Scope& scope) {
  Callee callee;
  const auto* name = std::get_if<Variable>(&call.function->node);
  if (!name) {
    const Value value = evaluate(*call.function, scope);
    if (!value.closure()) {
      environment_.warn(at, "a value of type " + std::string(value.type_name()) +
                                " cannot be called; the value of the call is undef");
      return std::nullopt;
    }
    callee.function = {value.closure()->definition, value.closure()->scope, nullptr};
    return callee;
  }
  const bool special = environment_.symbols.is_special(name->name);
  const Value* value = special ? environment_.dynamics.find(name->name) : scope.find(name->name);
  if (value && value->closure()) {
    callee.function = {value->closure()->definition, value->closure()->scope, nullptr};
    return callee;
  }
  callee.function = find_definition<FunctionDefinition>(name->name, scope, &Block::functions);
  if (callee.function) return callee;
  if (name->name == is_undef_) {
    callee.is_undef = true;
    return callee;
  }
  const auto builtin = builtins_.find(name->name);
  if (builtin == builtins_.end()) {
    warn_of_unknown_function(name->name, at, scope);
    return std::nullopt;
  }
  callee.builtin = builtin->second;
  return callee;
}

void ExpressionEvaluator::warn_of_unknown_function(Symbol name, Place at, Scope& scope) {
  std::vector<std::string_view> known;
  for (const auto& [symbol, function] : builtins_) known.push_back(environment_.text(symbol));
  for (const Scope* s = &scope; s; s = s->parent()) {
    if (!s->block()) continue;
    for (const auto& [symbol, function] : s->block()->functions) known.push_back(environment_.text(symbol));
  }
  // The table has no order of its own, and the message must not depend on it.
  std::sort(known.begin(), known.end());
  environment_.warn(at, "there is no function '" + environment_.text(name) + "'" +
                            suggestion(environment_.text(name), known) + "; the value of the call is undef");
}

std::string ExpressionEvaluator::echo_line(const std::vector<Argument>& arguments, Scope& scope) {
  std::string line;
  for (const Argument& argument : arguments) {
    if (!line.empty()) line += ", ";
    if (argument.name) line += environment_.text(argument.name) + " = ";
    line += format_value(evaluate(*argument.value, scope), environment_.symbols);
  }
  return line;
}

void ExpressionEvaluator::check_assertion(const std::vector<Argument>& arguments, Scope& scope, Place at) {
  const Expression* condition = nullptr;
  const Expression* message = nullptr;
  std::size_t position = 0;
  for (const Argument& argument : arguments) {
    const bool is_condition = argument.name ? argument.name == condition_ : position == 0;
    const bool is_message = argument.name ? argument.name == message_ : position == 1;
    if (!argument.name) ++position;
    if (is_condition) condition = argument.value;
    if (is_message) message = argument.value;
  }
  if (condition && evaluate(*condition, scope).truth()) return;
  std::string text = "assertion";
  if (condition) text += " '" + format_expression(*condition, environment_.symbols) + "'";
  text += " failed";
  if (message) text += ": " + format_value(evaluate(*message, scope), environment_.symbols);
  fail(at, text);
}

}  // namespace tenon::lang
