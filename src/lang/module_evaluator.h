#pragma once

#include <map>
#include <optional>
#include <string>
#include <unordered_map>

#include "lang/expression_evaluator.h"
#include "lang/scene_builder.h"
#include "tenon/lang/load.h"

namespace tenon::lang {

class ModuleEvaluator;

/// A call of a built-in module.
struct ModuleCall {
  ModuleEvaluator& evaluator;
  const Instantiation& instantiation;
  Scope& scope;

  Place at() const { return instantiation.at; }
};

/// What a built-in module makes; nothing at all (std::nullopt) where it is no operand of the operation around it.
using BuiltinModule = std::optional<Solid> (*)(ModuleCall&);
using BuiltinModuleTable = std::unordered_map<Symbol, BuiltinModule>;

void add_control_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_operation_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_transform_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_attribute_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_primitive_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_file_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_plane_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_outline_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_text_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_light_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_view_modules(BuiltinModuleTable& table, SymbolTable& symbols);
void add_unsupported_modules(BuiltinModuleTable& table, SymbolTable& symbols);

/// Evaluates statements and builds the scene they make.
class ModuleEvaluator {
 public:
  ModuleEvaluator(Environment& environment, const LoadOptions& options);

  /// Evaluates a file; the model's root is what it makes.
  void evaluate(const Unit& unit);

  /// The children of a call, each with what it makes.
  Solids children(const Block& block, Scope& scope);
  /// Some of the children of a block, by their numbers.
  Solids children(const Block& block, const std::vector<std::size_t>& which, Scope& scope);

  Environment& environment() { return environment_; }
  ExpressionEvaluator& expressions() { return expressions_; }
  SceneBuilder& builder() { return builder_; }
  const LoadOptions& options() const { return options_; }
  /// The value of a `$` variable when it is a number, else the fallback.
  double special_number(Symbol name, double fallback) const;

  /// The primitive that a mesh file became, by the statement that makes it; none yet when it is new.
  PrimitiveId& imported(const std::string& source) { return imported_[source]; }

  /// Where children of the call being evaluated stand: lights and cameras move with the transforms around them.
  Affine3 world_from_here;

  struct Names {
    Symbol children, parent_modules, fn, fa, fs;
  };
  const Names& names() const { return names_; }

 private:
  Ref<Scope> open_scope(const Block& block, Scope& scope);
  void instantiate(const Instantiation& instantiation, Scope& scope, Solids& out);
  std::optional<Solid> call(const Instantiation& instantiation, Scope& scope);
  Solid call_user_module(const Instantiation& instantiation, Scope& scope, const Found<ModuleDefinition>& module);
  [[noreturn]] void fail_unknown_module(const Instantiation& instantiation, Scope& scope);
  void set_special_defaults();

  Environment& environment_;
  const LoadOptions& options_;
  ExpressionEvaluator expressions_;
  SceneBuilder builder_;
  BuiltinModuleTable builtins_;
  Names names_;
  std::map<std::string, PrimitiveId> imported_;
  std::optional<Solid> root_;  // made by the first statement marked `!`
};

}  // namespace tenon::lang
