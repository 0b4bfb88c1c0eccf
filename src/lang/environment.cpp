#include "lang/environment.h"

namespace tenon::lang {

namespace {

// Nobody reads more; a million of them would only fill the memory.
constexpr std::size_t most_warnings = 1000;

}  // namespace

void Environment::warn(Place at, const std::string& message) {
  if (warned_.size() > most_warnings) return;
  const std::string key = (at.source ? at.source->name : "") + ':' + std::to_string(at.offset) + ':' + message;
  if (!warned_.insert(key).second) return;
  if (warned_.size() > most_warnings) {
    diagnostics.warn("there are more than 1000 warnings; the rest is not shown");
  } else {
    diagnostics.warn(message, locate(at));
  }
}

}  // namespace tenon::lang
