#include "lang/module_evaluator.h"

namespace tenon::lang {

namespace {

std::optional<Solid> not_supported(ModuleCall& call) {
  fail(call.at(), call.evaluator.environment().text(call.instantiation.name) +
                      "() is not supported yet; remove it, or disable it with '*'");
}

}  // namespace

void add_unsupported_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  for (const char* name : {"fill", "roof"}) {
    table.emplace(symbols.intern(name), not_supported);
  }
}

}  // namespace tenon::lang
