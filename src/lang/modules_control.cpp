#include <cmath>

#include "lang/format.h"
#include "lang/loops.h"
#include "lang/module_evaluator.h"

namespace tenon::lang {

namespace {

Solids children_of(ModuleCall& call) {
  return call.evaluator.children(*call.instantiation.children, call.scope);
}

std::optional<Solid> if_(ModuleCall& call) {
  const bool yes = call.evaluator.expressions().evaluate(*call.instantiation.arguments[0].value, call.scope).truth();
  const Block* chosen = yes ? call.instantiation.children : call.instantiation.else_children;
  if (!chosen) return std::nullopt;
  return call.evaluator.builder().unite(call.evaluator.children(*chosen, call.scope));
}

Solids all_turns(ModuleCall& call) {
  Solids parts;
  call.evaluator.expressions().for_each(call.instantiation.arguments, call.scope, [&](Scope& inner) {
    for (const Solid& part : call.evaluator.children(*call.instantiation.children, inner)) parts.push_back(part);
  });
  return parts;
}

std::optional<Solid> for_(ModuleCall& call) {
  return call.evaluator.builder().unite(all_turns(call));
}

std::optional<Solid> intersection_for(ModuleCall& call) {
  return call.evaluator.builder().intersect(all_turns(call));
}

std::optional<Solid> let(ModuleCall& call) {
  const Ref<Scope> inner = call.evaluator.expressions().bind_let(call.instantiation.arguments, call.scope);
  return call.evaluator.builder().unite(call.evaluator.children(*call.instantiation.children, *inner));
}

std::optional<Solid> assign(ModuleCall& call) {
  call.evaluator.environment().warn(call.at(), "assign() is deprecated; write an assignment, or let()");
  return let(call);
}

// Echoes and assertions are operands only where they have children.
std::optional<Solid> group_if_any(ModuleCall& call) {
  if (call.instantiation.children->instantiations.empty()) return std::nullopt;
  return call.evaluator.builder().unite(children_of(call));
}

std::optional<Solid> echo(ModuleCall& call) {
  call.evaluator.environment().diagnostics.say(
      "ECHO: " + call.evaluator.expressions().echo_line(call.instantiation.arguments, call.scope));
  return group_if_any(call);
}

std::optional<Solid> assert_(ModuleCall& call) {
  call.evaluator.expressions().check_assertion(call.instantiation.arguments, call.scope, call.at());
  return group_if_any(call);
}

// The index of a child, if there is one of that number.
void add_index(double number, std::size_t count, ModuleCall& call, std::vector<std::size_t>& which) {
  const double whole = std::trunc(number);
  if (whole >= 0 && whole < static_cast<double>(count)) {
    which.push_back(static_cast<std::size_t>(whole));
  } else {
    call.evaluator.environment().warn(call.at(), "there is no child " + format_number(whole) + "; there are " +
                                                     std::to_string(count) + ", counted from 0");
  }
}

// The children that the module around a call was given; nothing, with a warning, where there is no module around it.
std::optional<ChildrenFrame> frame_around(ModuleCall& call) {
  const Scope* around = &call.scope;
  while (around && !around->children) around = around->parent();
  if (around) return *around->children;
  const std::string name = call.evaluator.environment().text(call.instantiation.name);
  call.evaluator.environment().warn(call.at(), name + "() stands outside of all modules; it makes nothing");
  return std::nullopt;
}

std::optional<Solid> children(ModuleCall& call) {
  const std::optional<ChildrenFrame> frame = frame_around(call);
  if (!frame) return Solid::nothing();
  const std::size_t count = frame->block->instantiations.size();
  std::vector<std::size_t> which;
  if (call.instantiation.arguments.empty()) {
    for (std::size_t i = 0; i < count; ++i) which.push_back(i);
  } else {
    const Argument& argument = call.instantiation.arguments[0];
    const Value index = call.evaluator.expressions().evaluate(*argument.value, call.scope);
    if (!index.number() && !index.list() && !index.range()) {
      call.evaluator.environment().warn(argument.at,
                                        "children() takes a number, a list or a range, not a value of type " +
                                            std::string(index.type_name()) + "; it makes nothing");
      return Solid::nothing();
    }
    iterate(index, argument.at, call.evaluator.environment(), [&](const Value& item) {
      if (item.number()) add_index(*item.number(), count, call, which);
    });
  }
  return call.evaluator.builder().unite(call.evaluator.children(*frame->block, which, *frame->scope));
}

// What children() was before it took lists: one child, the first if no number is given.
std::optional<Solid> child(ModuleCall& call) {
  call.evaluator.environment().warn(call.at(), "child() is deprecated; write children(0), or the number of another");
  const std::optional<ChildrenFrame> frame = frame_around(call);
  if (!frame) return Solid::nothing();
  double number = 0;
  if (!call.instantiation.arguments.empty()) {
    const Value index = call.evaluator.expressions().evaluate(*call.instantiation.arguments[0].value, call.scope);
    number = index.number() ? *index.number() : 0;
  }
  std::vector<std::size_t> which;
  add_index(number, frame->block->instantiations.size(), call, which);
  return call.evaluator.builder().unite(call.evaluator.children(*frame->block, which, *frame->scope));
}

}  // namespace

void add_control_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinModule> modules[] = {
      {"if", if_},         {"for", for_},          {"intersection_for", intersection_for},
      {"let", let},        {"assign", assign},     {"echo", echo},
      {"assert", assert_}, {"children", children}, {"child", child},
  };
  for (const auto& [name, module] : modules) table.emplace(symbols.intern(name), module);
}

}  // namespace tenon::lang
