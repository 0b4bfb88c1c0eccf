#include "lang/loops.h"

#include "lang/format.h"

namespace tenon::lang {

std::size_t count_turns(const Range& range, Place at, Environment& environment) {
  if (range.step == 0) {
    environment.warn(at, "this range gets nowhere, for its step is 0; it is taken for empty");
    return 0;
  }
  const double size = range.size();
  if (size > longest_range) {
    fail(at, "a range of " + (size < 1e300 ? format_number(size) : std::string("endlessly many")) +
                 " numbers is too long; at most 10,000,000 are allowed");
  }
  if (size == 0 && (range.end - range.begin) * range.step < 0) {
    environment.warn(at, "this range is empty: its step leads away from its end");
  }
  return static_cast<std::size_t>(size);
}

}  // namespace tenon::lang
