#include "lang/module_evaluator.h"

#include <algorithm>
#include <numbers>
#include <numeric>

#include "tenon/base/suggestion.h"

namespace tenon::lang {

ModuleEvaluator::ModuleEvaluator(Environment& environment, const LoadOptions& options)
    : environment_(environment), options_(options), expressions_(environment) {
  SymbolTable& symbols = environment.symbols;
  names_ = {symbols.intern("$children"), symbols.intern("$parent_modules"), symbols.intern("$fn"),
            symbols.intern("$fa"), symbols.intern("$fs")};
  add_control_modules(builtins_, symbols);
  add_operation_modules(builtins_, symbols);
  add_transform_modules(builtins_, symbols);
  add_attribute_modules(builtins_, symbols);
  add_primitive_modules(builtins_, symbols);
  add_file_modules(builtins_, symbols);
  add_plane_modules(builtins_, symbols);
  add_outline_modules(builtins_, symbols);
  add_text_modules(builtins_, symbols);
  add_light_modules(builtins_, symbols);
  add_view_modules(builtins_, symbols);
  add_unsupported_modules(builtins_, symbols);
}

void ModuleEvaluator::set_special_defaults() {
  const auto set = [&](std::string_view name, Value value) {
    environment_.dynamics.push(environment_.symbols.intern(name), std::move(value));
  };
  Budget& budget = environment_.budget;
  set("$fn", Value(0.0));
  set("$fa", Value(12.0));
  set("$fs", Value(2.0));
  set("$t", Value(options_.time));
  set("$preview", Value(false));
  set("$vpr", make_list({55, 0, 25}, budget));
  set("$vpt", make_list({0, 0, 0}, budget));
  set("$vpd", Value(140.0));
  set("$vpf", Value(22.5));
}

void ModuleEvaluator::evaluate(const Unit& unit) {
  set_special_defaults();
  const Ref<Scope> built_in = make_ref<Scope>(environment_.scopes, Ref<Scope>());
  built_in->set(environment_.symbols.intern("PI"), Value(std::numbers::pi));
  const Ref<Scope> file = make_ref<Scope>(environment_.scopes, built_in, &unit.block);
  file->unit = &unit;
  expressions_.set_built_in_scope(built_in);
  expressions_.assign(unit.block, *file);
  Solids parts;
  for (const Instantiation* statement : unit.block.instantiations) instantiate(*statement, *file, parts);
  const Solid solid = root_ ? *root_ : builder_.unite(parts);
  if (solid.is_everything()) {
    fail({unit.block.instantiations.front()->at},
         "the scene is all of space; intersect the complement with a solid that bounds it");
  }
  builder_.model().graph.root = solid.node;
  if (!solid.flat) return;
  environment_.warn({unit.block.instantiations.front()->at},
                    "the scene is a shape of the plane; it is drawn 1 thick, as OpenSCAD's preview does. Extrude it");
  const Transform middle{Affine3::translate({0, 0, -0.5})};
  builder_.model().graph.root = builder_.wrap(middle, {solid}).node;
}

// A block without definitions needs no scope of its own; so a name is found at once however deep braces are nested.
Ref<Scope> ModuleEvaluator::open_scope(const Block& block, Scope& scope) {
  if (block.assignments.empty() && block.functions.empty() && block.modules.empty()) return Ref<Scope>(&scope);
  Ref<Scope> inner = make_ref<Scope>(environment_.scopes, Ref<Scope>(&scope), &block);
  expressions_.assign(block, *inner);
  return inner;
}

Solids ModuleEvaluator::children(const Block& block, Scope& scope) {
  const DynamicFrame frame(environment_.dynamics);
  const Ref<Scope> inner = open_scope(block, scope);
  Solids parts;
  for (const Instantiation* statement : block.instantiations) instantiate(*statement, *inner, parts);
  return parts;
}

Solids ModuleEvaluator::children(const Block& block, const std::vector<std::size_t>& which, Scope& scope) {
  const DynamicFrame frame(environment_.dynamics);
  const Ref<Scope> inner = open_scope(block, scope);
  Solids parts;
  for (std::size_t index : which) instantiate(*block.instantiations[index], *inner, parts);
  return parts;
}

void ModuleEvaluator::instantiate(const Instantiation& instantiation, Scope& scope, Solids& out) {
  expressions_.check_depth(instantiation.at);
  environment_.current = instantiation.at;
  const std::optional<Solid> made = call(instantiation, scope);
  if (!made) return;
  if (instantiation.root) {
    if (root_) environment_.warn(instantiation.at, "there is more than one '!'; only the first counts");
    if (!root_) root_ = made;
  }
  if (instantiation.background) return;
  const auto other = std::find_if(out.begin(), out.end(), [](const Solid& s) { return !s.is_nothing(); });
  if (other != out.end() && !made->is_nothing() && other->flat != made->flat) {
    environment_.warn(instantiation.at, made->flat
                                            ? "a shape of the plane stands beside solids; it is dropped. Extrude it"
                                            : "a solid stands beside shapes of the plane; it is dropped");
    return;
  }
  out.push_back(*made);
}

std::optional<Solid> ModuleEvaluator::call(const Instantiation& instantiation, Scope& scope) {
  const DynamicFrame frame(environment_.dynamics);
  if (const auto module = expressions_.find_module(instantiation.name, scope)) {
    return call_user_module(instantiation, scope, module);
  }
  const auto builtin = builtins_.find(instantiation.name);
  if (builtin == builtins_.end()) fail_unknown_module(instantiation, scope);
  ModuleCall call{*this, instantiation, scope};
  return builtin->second(call);
}

Solid ModuleEvaluator::call_user_module(const Instantiation& instantiation, Scope& scope,
                                        const Found<ModuleDefinition>& module) {
  CallCount count(environment_.calls);
  count.count(instantiation.at);
  const ModuleDefinition& definition = *module.definition;
  const Ref<Scope> inner =
      expressions_.bind_call(definition.parameters, instantiation.arguments, scope, module.scope, definition.body);
  expressions_.enter_unit(module.used);
  const ChildrenFrame frame{instantiation.children, &scope};
  inner->children = &frame;
  environment_.module_stack.push_back(definition.name);
  DynamicVariables& dynamics = environment_.dynamics;
  inner->set(names_.children, Value(static_cast<double>(frame.block->instantiations.size())));
  dynamics.push(names_.parent_modules, Value(static_cast<double>(environment_.module_stack.size())));
  expressions_.assign(*definition.body, *inner);
  Solids parts;
  for (const Instantiation* statement : definition.body->instantiations) instantiate(*statement, *inner, parts);
  environment_.module_stack.pop_back();
  inner->children = nullptr;
  return builder_.unite(parts);
}

void ModuleEvaluator::fail_unknown_module(const Instantiation& instantiation, Scope& scope) {
  std::vector<std::string_view> known;
  for (const auto& [symbol, module] : builtins_) known.push_back(environment_.text(symbol));
  for (const Scope* s = &scope; s; s = s->parent()) {
    if (s->block()) {
      for (const auto& [symbol, module] : s->block()->modules) known.push_back(environment_.text(symbol));
    }
    if (!s->unit) continue;
    for (const Unit* used : s->unit->used) {
      for (const auto& [symbol, module] : used->block.modules) known.push_back(environment_.text(symbol));
    }
  }
  std::sort(known.begin(), known.end());
  const std::string& name = environment_.text(instantiation.name);
  fail(instantiation.at, "there is no module '" + name + "'" + suggestion(name, known));
}

double ModuleEvaluator::special_number(Symbol name, double fallback) const {
  const Value* value = environment_.dynamics.find(name);
  return value && value->number() ? *value->number() : fallback;
}

}  // namespace tenon::lang
