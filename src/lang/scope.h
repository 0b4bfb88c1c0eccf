#pragma once

#include <memory>
#include <unordered_map>
#include <utility>
#include <vector>

#include "lang/ast.h"
#include "lang/value.h"

namespace tenon::lang {

class Scope;

/// The children of a module that is being evaluated, with the variables they see.
struct ChildrenFrame {
  const Block* block;
  Scope* scope;
};

/// Every scope alive. A function that its own scope holds makes a cycle of references; clear() breaks them all.
class ScopeRegistry {
 public:
  ScopeRegistry() = default;
  ScopeRegistry(const ScopeRegistry&) = delete;
  ScopeRegistry& operator=(const ScopeRegistry&) = delete;
  ~ScopeRegistry() { clear(); }
  void clear();

 private:
  friend class Scope;
  Scope* first_ = nullptr;
};

/// The variables of a file, a call, a `let` or one turn of a loop, and the way outwards in the text.
class Scope : public RefCounted {
 public:
  Scope(ScopeRegistry& registry, Ref<Scope> parent, const Block* block = nullptr);
  ~Scope() override;

  Scope* parent() const { return parent_.get(); }
  /// Where functions and modules of this scope are defined; null when it has none.
  const Block* block() const { return block_; }

  /// A variable of this very scope; null when there is none.
  const Value* find_here(Symbol name) const;
  /// A variable of this scope or the nearest one outwards.
  const Value* find(Symbol name) const;
  /// Sets a variable of this scope; false when it was set before.
  bool set(Symbol name, Value value);

  const Unit* unit = nullptr;               ///< of a file's scope
  const ChildrenFrame* children = nullptr;  ///< of a module's scope

 private:
  friend class ScopeRegistry;
  static constexpr std::size_t index_from = 16;  // from this many variables on, a search is slower than a table

  Ref<Scope> parent_;
  const Block* block_;
  std::vector<std::pair<Symbol, Value>> variables_;
  std::unique_ptr<std::unordered_map<Symbol, std::size_t>> index_;
  ScopeRegistry* registry_;
  Scope* next_;
  Scope* previous_ = nullptr;
};

}  // namespace tenon::lang
