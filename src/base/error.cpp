#include "tenon/base/error.h"

#include <algorithm>

namespace tenon {

namespace {

// Long generated lines are cut to a window around the column, so that the caret stays on the screen.
constexpr std::size_t window = 160;

}  // namespace

std::string format_message(Severity severity, const std::string& message, const SourceLocation& where) {
  std::string out;
  if (where.known()) {
    out += where.file;
    if (where.line > 0) out += ':' + std::to_string(where.line) + ':' + std::to_string(where.column);
    out += ": ";
  } else {
    out += "tenon: ";
  }
  out += severity == Severity::error ? "error: " : "warning: ";
  out += message;
  if (where.line <= 0 || where.text.empty()) return out;

  std::size_t column = where.column > 0 ? static_cast<std::size_t>(where.column - 1) : 0;
  column = std::min(column, where.text.size());
  const std::size_t begin = column > window / 2 ? column - window / 2 : 0;
  std::string line = where.text.substr(begin, window);
  std::string caret;
  for (std::size_t i = 0; i < column - begin; ++i) caret += line[i] == '\t' ? '\t' : ' ';
  return out + "\n    " + line + "\n    " + caret + '^';
}

}  // namespace tenon
