#pragma once

#include <functional>
#include <optional>
#include <unordered_map>

#include "lang/builtin_functions.h"
#include "lang/environment.h"

namespace tenon::lang {

/// A definition with the scope it was made in.
template <class Definition>
struct Found {
  const Definition* definition = nullptr;
  Ref<Scope> scope;
  const Unit* used = nullptr;  ///< the file it comes from by `use`; null for the own file's

  explicit operator bool() const { return definition != nullptr; }
};

/// Evaluates expressions, and the assignments of blocks.
class ExpressionEvaluator {
 public:
  explicit ExpressionEvaluator(Environment& environment);

  Value evaluate(const Expression& expression, Scope& scope);

  /// Sets the variables of a block in a scope, in order.
  void assign(const Block& block, Scope& scope);
  /// The scope of a call: parameters bound to arguments, which are evaluated in the caller's scope. `$` arguments are
  /// set until the caller's DynamicFrame ends.
  Ref<Scope> bind_call(const std::vector<Parameter>& parameters, const std::vector<Argument>& arguments, Scope& caller,
                       Ref<Scope> definition_scope, const Block* body);
  /// The scope of a `let`: each binding sees the ones before it.
  Ref<Scope> bind_let(const std::vector<Argument>& bindings, Scope& scope);
  /// Sets a variable of this scope, or a `$` variable for the current DynamicFrame; false when the scope has it
  /// already.
  bool set_variable(Symbol name, Value value, Scope& scope);
  /// Calls `turn` with a scope for each combination of the bindings of a `for`.
  void for_each(const std::vector<Argument>& bindings, Scope& scope, const std::function<void(Scope&)>& turn);

  /// "a, b = 2": the arguments of an `echo` as it shows them.
  std::string echo_line(const std::vector<Argument>& arguments, Scope& scope);
  /// Fails unless the condition among the arguments of an `assert` is true.
  void check_assertion(const std::vector<Argument>& arguments, Scope& scope, Place at);

  /// A module, sought from a scope outwards and then in the files it uses.
  Found<ModuleDefinition> find_module(Symbol name, Scope& scope);
  /// Sets the `$` variables that a used file assigns, for the current DynamicFrame.
  void enter_unit(const Unit* unit);
  /// What lies around every file: the constants of the language.
  void set_built_in_scope(Ref<Scope> scope) { built_in_scope_ = std::move(scope); }

  /// Fails when calls are nested too deep.
  void check_depth(Place at) const;

 private:
  struct Callee {
    BuiltinFunction builtin = nullptr;
    bool is_undef = false;  // the function of that name
    Found<FunctionDefinition> function;
  };
  struct UnitState {
    Ref<Scope> scope;
    std::vector<std::pair<Symbol, Value>> specials;
  };

  Value variable(const Variable& variable, Place at, Scope& scope);
  Value binary(const Binary& binary, Place at, Scope& scope);
  Value list(const ListLiteral& literal, Scope& scope);
  Value range(const RangeLiteral& literal, Place at, Scope& scope);
  Value builtin_call(const Callee& callee, const Call& call, Place at, Scope& scope);
  Value test_undef(const Call& call, Scope& scope);
  std::optional<Callee> resolve(const Call& call, Place at, Scope& scope);
  void warn_of_unknown_function(Symbol name, Place at, Scope& scope);

  // Elements of list comprehensions: comprehension.cpp.
  void element(const Expression& expression, Scope& scope, ListBuilder& out);
  void loop_element(const LoopElement& loop, Place at, Scope& scope, ListBuilder& out);
  void turns(const std::vector<Argument>& bindings, std::size_t index, Scope& scope,
             const std::function<void(Scope&)>& turn);

  const UnitState& unit_state(const Unit& unit);
  template <class Definition>
  Found<Definition> find_definition(Symbol name, Scope& scope,
                                    std::unordered_map<Symbol, const Definition*> Block::*table);

  Environment& environment_;
  BuiltinFunctionTable builtins_;
  Symbol is_undef_;
  Symbol condition_, message_;
  Ref<Scope> built_in_scope_;
  std::unordered_map<const Unit*, UnitState> units_;
};

}  // namespace tenon::lang
