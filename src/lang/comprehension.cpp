#include "lang/expression_evaluator.h"
#include "lang/loops.h"

namespace tenon::lang {

void ExpressionEvaluator::element(const Expression& e, Scope& scope, ListBuilder& out) {
  const DynamicFrame frame(environment_.dynamics);
  if (const auto* loop = std::get_if<ForElement>(&e.node)) {
    check_depth(e.at);
    for_each(loop->bindings, scope, [&](Scope& inner) { element(*loop->body, inner, out); });
  } else if (const auto* choice = std::get_if<IfElement>(&e.node)) {
    check_depth(e.at);
    const bool yes = evaluate(*choice->condition, scope).truth();
    if (const Expression* chosen = yes ? choice->yes : choice->no) element(*chosen, scope, out);
  } else if (const auto* let = std::get_if<LetElement>(&e.node)) {
    check_depth(e.at);
    const Ref<Scope> inner = bind_let(let->bindings, scope);
    element(*let->body, *inner, out);
  } else if (const auto* each = std::get_if<EachElement>(&e.node)) {
    check_depth(e.at);
    ListBuilder operands(environment_.budget);
    element(*each->operand, scope, operands);
    const Value collected = std::move(operands).finish();
    for (const Value& operand : collected.list()->items()) {
      iterate(operand, e.at, environment_, [&](const Value& item) { out.add(item); });
    }
  } else if (const auto* loop_with_condition = std::get_if<LoopElement>(&e.node)) {
    check_depth(e.at);
    loop_element(*loop_with_condition, e.at, scope, out);
  } else {
    out.add(evaluate(e, scope));
  }
}

// `for (start; condition; step)`: each turn has a scope of its own, and all steps of a turn see the turn's values and
// the steps before them.
void ExpressionEvaluator::loop_element(const LoopElement& loop, Place at, Scope& scope, ListBuilder& out) {
  Ref<Scope> current = bind_let(loop.start, scope);
  for (double turns_made = 0; evaluate(*loop.condition, *current).truth(); ++turns_made) {
    if (turns_made >= longest_range) fail(at, "this loop has made 10,000,000 turns; check that its condition ends it");
    element(*loop.body, *current, out);
    // The next turn's scope stands beside this one, not within it, or the chain would grow with every turn.
    const Ref<Scope> next = make_ref<Scope>(environment_.scopes, Ref<Scope>(&scope));
    const Ref<Scope> view = make_ref<Scope>(environment_.scopes, current);
    for (const Argument& step : loop.step) {
      if (!step.name) continue;
      const Value value = evaluate(*step.value, *view);
      set_variable(step.name, value, *next);
      if (!environment_.symbols.is_special(step.name)) view->set(step.name, value);
    }
    for (const Argument& start : loop.start) {
      if (start.name && !next->find_here(start.name)) {
        if (const Value* value = current->find_here(start.name)) next->set(start.name, *value);
      }
    }
    current = next;
  }
}

void ExpressionEvaluator::for_each(const std::vector<Argument>& bindings, Scope& scope,
                                   const std::function<void(Scope&)>& turn) {
  if (!bindings.empty()) turns(bindings, 0, scope, turn);
}

void ExpressionEvaluator::turns(const std::vector<Argument>& bindings, std::size_t index, Scope& scope,
                                const std::function<void(Scope&)>& turn) {
  if (index == bindings.size()) return turn(scope);
  const Argument& binding = bindings[index];
  iterate(evaluate(*binding.value, scope), binding.at, environment_, [&](const Value& value) {
    const DynamicFrame frame(environment_.dynamics);
    const Ref<Scope> inner = make_ref<Scope>(environment_.scopes, Ref<Scope>(&scope));
    if (binding.name) set_variable(binding.name, value, *inner);
    turns(bindings, index + 1, *inner, turn);
  });
}

}  // namespace tenon::lang
