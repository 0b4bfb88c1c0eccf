#include "lang/symbol.h"

namespace tenon::lang {

Symbol SymbolTable::intern(std::string_view text) {
  if (const auto found = index_.find(text); found != index_.end()) return found->second;
  const Symbol symbol{texts_.size()};
  texts_.emplace_back(text);
  special_.push_back(text.starts_with('$') && text != "$children");
  index_.emplace(texts_.back(), symbol);
  return symbol;
}

}  // namespace tenon::lang
