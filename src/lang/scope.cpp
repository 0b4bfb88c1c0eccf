#include "lang/scope.h"

namespace tenon::lang {

void ScopeRegistry::clear() {
  while (first_) {
    const Ref<Scope> scope(first_);
    scope->parent_ = {};
    scope->variables_.clear();
    scope->index_.reset();
    // Read now: scopes that only this one held are gone from the list.
    first_ = scope->next_;
    if (first_) first_->previous_ = nullptr;
    scope->registry_ = nullptr;
  }
}

Scope::Scope(ScopeRegistry& registry, Ref<Scope> parent, const Block* block)
    : parent_(std::move(parent)), block_(block), registry_(&registry), next_(registry.first_) {
  if (next_) next_->previous_ = this;
  registry.first_ = this;
}

Scope::~Scope() {
  if (!registry_) return;
  if (previous_) {
    previous_->next_ = next_;
  } else {
    registry_->first_ = next_;
  }
  if (next_) next_->previous_ = previous_;
}

const Value* Scope::find_here(Symbol name) const {
  if (index_) {
    const auto found = index_->find(name);
    return found == index_->end() ? nullptr : &variables_[found->second].second;
  }
  for (const auto& [symbol, value] : variables_) {
    if (symbol == name) return &value;
  }
  return nullptr;
}

const Value* Scope::find(Symbol name) const {
  for (const Scope* scope = this; scope; scope = scope->parent()) {
    if (const Value* value = scope->find_here(name)) return value;
  }
  return nullptr;
}

bool Scope::set(Symbol name, Value value) {
  if (const Value* old = find_here(name)) {
    const_cast<Value&>(*old) = std::move(value);
    return false;
  }
  variables_.emplace_back(name, std::move(value));
  if (index_) {
    index_->emplace(name, variables_.size() - 1);
  } else if (variables_.size() >= index_from) {
    index_ = std::make_unique<std::unordered_map<Symbol, std::size_t>>();
    for (std::size_t i = 0; i < variables_.size(); ++i) index_->emplace(variables_[i].first, i);
  }
  return true;
}

}  // namespace tenon::lang
