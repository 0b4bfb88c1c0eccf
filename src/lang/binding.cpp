#include <algorithm>

#include "lang/expression_evaluator.h"
#include "tenon/base/suggestion.h"

namespace tenon::lang {

void ExpressionEvaluator::assign(const Block& block, Scope& scope) {
  for (const Assignment& assignment : block.assignments) {
    set_variable(assignment.name, evaluate(*assignment.value, scope), scope);
  }
}

bool ExpressionEvaluator::set_variable(Symbol name, Value value, Scope& scope) {
  if (!environment_.symbols.is_special(name)) return scope.set(name, std::move(value));
  environment_.dynamics.push(name, std::move(value));
  return true;
}

Ref<Scope> ExpressionEvaluator::bind_let(const std::vector<Argument>& bindings, Scope& scope) {
  const Ref<Scope> inner = make_ref<Scope>(environment_.scopes, Ref<Scope>(&scope));
  for (auto at = bindings.begin(); at != bindings.end(); ++at) {
    const Argument& binding = *at;
    Value value = evaluate(*binding.value, *inner);
    if (!binding.name) continue;
    if (std::any_of(bindings.begin(), at, [&](const Argument& before) { return before.name == binding.name; })) {
      environment_.warn(binding.at,
                        "'" + environment_.text(binding.name) + "' is set twice here; the second value is ignored");
    } else {
      set_variable(binding.name, std::move(value), *inner);
    }
  }
  return inner;
}

Ref<Scope> ExpressionEvaluator::bind_call(const std::vector<Parameter>& parameters,
                                          const std::vector<Argument>& arguments, Scope& caller,
                                          // Held, since evaluating the arguments may drop its last other owner.
                                          Ref<Scope> definition_scope,  // NOLINT(performance-unnecessary-value-param)
                                          const Block* body) {
  std::vector<Value> values;
  values.reserve(arguments.size());
  for (const Argument& argument : arguments) values.push_back(evaluate(*argument.value, caller));

  const Ref<Scope> inner = make_ref<Scope>(environment_.scopes, definition_scope, body);
  std::vector<bool> given(parameters.size(), false);
  std::size_t position = 0;
  for (std::size_t i = 0; i < arguments.size(); ++i) {
    const Argument& argument = arguments[i];
    std::size_t slot = 0;
    if (!argument.name) {
      slot = position++;
      if (slot >= parameters.size()) {
        environment_.warn(argument.at, "there are more arguments than the " + std::to_string(parameters.size()) +
                                           " parameters; the rest is ignored");
        continue;
      }
    } else {
      while (slot < parameters.size() && parameters[slot].name != argument.name) ++slot;
    }
    if (slot < parameters.size()) {
      if (given[slot]) {
        environment_.warn(argument.at, "the parameter '" + environment_.text(parameters[slot].name) +
                                           "' is given twice; the last value holds");
      }
      given[slot] = true;
      set_variable(parameters[slot].name, std::move(values[i]), *inner);
    } else if (environment_.symbols.is_special(argument.name)) {
      set_variable(argument.name, std::move(values[i]), *inner);
    } else {
      std::vector<std::string_view> names;
      for (const Parameter& parameter : parameters) names.push_back(environment_.text(parameter.name));
      environment_.warn(argument.at, "there is no parameter '" + environment_.text(argument.name) + "'" +
                                         suggestion(environment_.text(argument.name), names) + "; it is ignored");
    }
  }
  for (std::size_t slot = 0; slot < parameters.size(); ++slot) {
    if (given[slot]) continue;
    const Expression* fallback = parameters[slot].fallback;
    set_variable(parameters[slot].name, fallback ? evaluate(*fallback, *definition_scope) : Value(), *inner);
  }
  return inner;
}

// A used file's variables are evaluated once, when something of it is first called.
const ExpressionEvaluator::UnitState& ExpressionEvaluator::unit_state(const Unit& unit) {
  const auto [entry, is_new] = units_.try_emplace(&unit);
  UnitState& state = entry->second;
  if (!is_new) return state;
  const DynamicFrame frame(environment_.dynamics);
  state.scope = make_ref<Scope>(environment_.scopes, built_in_scope_, &unit.block);
  state.scope->unit = &unit;
  for (const Assignment& assignment : unit.block.assignments) {
    const Value value = evaluate(*assignment.value, *state.scope);
    set_variable(assignment.name, value, *state.scope);
    if (environment_.symbols.is_special(assignment.name)) state.specials.emplace_back(assignment.name, value);
  }
  return state;
}

void ExpressionEvaluator::enter_unit(const Unit* unit) {
  if (!unit) return;
  for (const auto& [name, value] : unit_state(*unit).specials) environment_.dynamics.push(name, value);
}

template <class Definition>
Found<Definition> ExpressionEvaluator::find_definition(Symbol name, Scope& scope,
                                                       std::unordered_map<Symbol, const Definition*> Block::*table) {
  const Unit* unit = nullptr;
  for (Scope* s = &scope; s; s = s->parent()) {
    if (s->unit) unit = s->unit;
    if (!s->block()) continue;
    const auto& definitions = s->block()->*table;
    if (const auto found = definitions.find(name); found != definitions.end()) {
      return {found->second, Ref<Scope>(s), nullptr};
    }
  }
  if (!unit) return {};
  for (const Unit* used : unit->used) {
    const auto& definitions = used->block.*table;
    if (const auto found = definitions.find(name); found != definitions.end()) {
      return {found->second, unit_state(*used).scope, used};
    }
  }
  return {};
}

Found<ModuleDefinition> ExpressionEvaluator::find_module(Symbol name, Scope& scope) {
  return find_definition<ModuleDefinition>(name, scope, &Block::modules);
}

template Found<FunctionDefinition> ExpressionEvaluator::find_definition(
    Symbol, Scope&, std::unordered_map<Symbol, const FunctionDefinition*> Block::*);

}  // namespace tenon::lang
