#pragma once

#include <functional>

#include "lang/environment.h"

namespace tenon::lang {

/// Beyond this many turns a single range is taken for a mistake, as are the turns of a loop with a condition.
inline constexpr double longest_range = 1e7;

/// Calls `turn` for each value that `for (i = value)` takes: the numbers of a range, the members of a list, the
/// characters of a string, nothing for undef, and any other value itself.
template <class Turn>
void iterate(const Value& value, Place at, Environment& environment, Turn&& turn);

/// How many turns a range makes; fails when they are too many.
std::size_t count_turns(const Range& range, Place at, Environment& environment);

template <class Turn>
void iterate(const Value& value, Place at, Environment& environment, Turn&& turn) {
  // A turn may end the life of what it runs over.
  const Value held = value;  // NOLINT(performance-unnecessary-copy-initialization)
  if (const Range* range = held.range()) {
    const std::size_t count = count_turns(*range, at, environment);
    for (std::size_t i = 0; i < count; ++i) turn(Value(range->at(i)));
  } else if (const List* list = held.list()) {
    for (const Value& item : list->items()) turn(item);
  } else if (const String* string = held.string()) {
    for (std::size_t i = 0; i < string->length(); ++i)
      turn(make_string(std::string(string->at(i)), environment.budget));
  } else if (!held.is_undef()) {
    turn(held);
  }
}

}  // namespace tenon::lang
