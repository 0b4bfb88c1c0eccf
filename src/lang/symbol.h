#pragma once

#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "tenon/base/id.h"

namespace tenon::lang {

/// An interned name.
using Symbol = Id<struct Symbol_>;

/// The names of one evaluation.
class SymbolTable {
 public:
  Symbol intern(std::string_view text);
  const std::string& text(Symbol symbol) const { return texts_[symbol.get()]; }
  /// `$fn` and its like: looked up through the calls, not through the text. `$children` alone is not: children see
  /// those of the module they are written in.
  bool is_special(Symbol symbol) const { return special_[symbol.get()]; }
  std::size_t size() const { return texts_.size(); }

 private:
  std::deque<std::string> texts_;  // a deque, so that the views in index_ stay valid
  std::vector<bool> special_;
  std::unordered_map<std::string_view, Symbol> index_;
};

}  // namespace tenon::lang
