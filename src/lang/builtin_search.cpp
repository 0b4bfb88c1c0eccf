#include <cmath>
#include <functional>
#include <limits>

#include "lang/builtin_functions.h"
#include "lang/utf8.h"

namespace tenon::lang {

namespace {

/// What `search` was asked for besides what and where.
struct SearchOptions {
  std::size_t most;    // matches per thing sought; SIZE_MAX for all
  std::size_t column;  // of a row of the table, where the table has rows
};

using Match = std::function<bool(std::size_t)>;

// The indices below `count` that match: the first alone, or a list when several were asked for. Null: none was found
// and one was asked for.
std::vector<double> matches(std::size_t count, const SearchOptions& options, const Match& match) {
  std::vector<double> found;
  for (std::size_t i = 0; i < count && found.size() < options.most; ++i) {
    if (match(i)) found.push_back(static_cast<double>(i));
  }
  return found;
}

// Adds what was found for one of several things sought; false when one match was asked for and there is none.
bool add_found(const std::vector<double>& found, const SearchOptions& options, ListBuilder& out, Budget& budget) {
  if (options.most != 1) {
    out.add(make_list(found, budget));
    return true;
  }
  if (found.empty()) return false;
  out.add(Value(found.front()));
  return true;
}

// An item of the table, or the column of it when it is a row.
const Value* cell(const Value& item, std::size_t column) {
  const List* row = item.list();
  if (!row) return &item;
  return column < row->items().size() ? &row->items()[column] : nullptr;
}

Value search_number_or_string(const BuiltinCall& call, const Value& what, const List& table,
                              const SearchOptions& options) {
  return make_list(matches(table.items().size(), options,
                           [&](std::size_t i) {
                             const Value* value = cell(table.items()[i], options.column);
                             return value && equal(*value, what);
                           }),
                   call.environment.budget);
}

// Each character of a string, in a string.
Value search_characters(const BuiltinCall& call, const String& what, const String& text, const SearchOptions& options) {
  ListBuilder out(call.environment.budget);
  for (std::size_t k = 0; k < what.length(); ++k) {
    const std::string_view character = what.at(k);
    const auto found = matches(text.length(), options, [&](std::size_t i) { return text.at(i) == character; });
    add_found(found, options, out, call.environment.budget);
  }
  return std::move(out).finish();
}

// Each character of a string, in the column of a table.
Value search_characters(const BuiltinCall& call, const String& what, const List& table, const SearchOptions& options) {
  for (std::size_t i = 0; i < table.items().size(); ++i) {
    const List* row = table.items()[i].list();
    if (row && options.column < row->items().size()) continue;
    call.environment.warn(call.at, "search() of a string in a list needs rows of more than " +
                                       std::to_string(options.column) + " members, but member " + std::to_string(i) +
                                       " has not; nothing is found");
    return make_list({}, call.environment.budget);
  }
  ListBuilder out(call.environment.budget);
  for (std::size_t k = 0; k < what.length(); ++k) {
    const std::string_view character = what.at(k);
    const auto found = matches(table.items().size(), options, [&](std::size_t i) {
      const String* text = table.items()[i].list()->items()[options.column].string();
      return text && text->length() > 0 && text->at(0) == character;
    });
    if (!add_found(found, options, out, call.environment.budget)) {
      call.environment.warn(call.at, "search() does not find \"" + std::string(character) + "\"");
    }
  }
  return std::move(out).finish();
}

// Each member of a list, in a list: as a whole, or in the column of a row.
Value search_members(const BuiltinCall& call, const List& what, const Value& where, const SearchOptions& options) {
  ListBuilder out(call.environment.budget);
  for (const Value& sought : what.items()) {
    std::vector<double> found;
    if (const List* table = where.list()) {
      found = matches(table->items().size(), options, [&](std::size_t i) {
        const Value& item = table->items()[i];
        if (equal(item, sought)) return true;
        const Value* value = item.list() ? cell(item, options.column) : nullptr;
        return value && equal(*value, sought);
      });
    }
    if (!add_found(found, options, out, call.environment.budget)) out.add(make_list({}, call.environment.budget));
  }
  return std::move(out).finish();
}

std::size_t count_option(const BuiltinCall& call, std::size_t index, std::size_t fallback) {
  if (call.arguments.size() <= index || !call.arguments[index].number()) return fallback;
  const double value = *call.arguments[index].number();
  return value >= 0 && value < 1e9 ? static_cast<std::size_t>(value) : fallback;
}

Value search(const BuiltinCall& call) {
  if (!call.has_arguments(2, 4)) return {};
  const Value& what = call.arguments[0];
  const Value& where = call.arguments[1];
  SearchOptions options{count_option(call, 2, 1), count_option(call, 3, 0)};
  if (options.most == 0) options.most = std::numeric_limits<std::size_t>::max();
  if (what.list()) return search_members(call, *what.list(), where, options);
  if (what.string() && where.string()) return search_characters(call, *what.string(), *where.string(), options);
  if (what.string() && where.list()) return search_characters(call, *what.string(), *where.list(), options);
  if (what.number() && where.list()) return search_number_or_string(call, what, *where.list(), options);
  if (what.is_undef() || what.boolean() || what.range() || what.closure()) return {};
  return make_list({}, call.environment.budget);
}

}  // namespace

void add_search_functions(BuiltinFunctionTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("search"), search);
}

}  // namespace tenon::lang
