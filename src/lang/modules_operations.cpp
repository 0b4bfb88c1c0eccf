#include "lang/module_evaluator.h"

namespace tenon::lang {

namespace {

// These take no arguments, and as in OpenSCAD they do not look at any.
Solids children_of(ModuleCall& call) {
  return call.evaluator.children(*call.instantiation.children, call.scope);
}

std::optional<Solid> union_(ModuleCall& call) {
  return call.evaluator.builder().unite(children_of(call));
}
std::optional<Solid> intersection(ModuleCall& call) {
  return call.evaluator.builder().intersect(children_of(call));
}
std::optional<Solid> difference(ModuleCall& call) {
  return call.evaluator.builder().subtract(children_of(call));
}
std::optional<Solid> complement(ModuleCall& call) {
  return call.evaluator.builder().complement(children_of(call));
}

}  // namespace

void add_operation_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  const std::pair<const char*, BuiltinModule> modules[] = {
      {"union", union_},          {"group", union_},          {"render", union_}, {"intersection", intersection},
      {"difference", difference}, {"complement", complement},
  };
  for (const auto& [name, module] : modules) table.emplace(symbols.intern(name), module);
}

}  // namespace tenon::lang
