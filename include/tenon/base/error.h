#pragma once

#include <string>
#include <utility>
#include <variant>

namespace tenon {

/// A place in a text file. Lines and columns count from 1; columns count bytes.
struct SourceLocation {
  std::string file;
  int line = 0;
  int column = 0;
  std::string text;  ///< the line itself, without its end; shown under the message with a caret

  bool known() const { return !file.empty(); }
};

/// Who has to act, and with which exit status a program ends.
enum class ErrorKind {
  input = 1,    ///< the scene or an input is wrong
  usage = 2,    ///< the command line is wrong
  machine = 3,  ///< the machine failed us: disk full, out of memory
};

/// What went wrong, where, and what to do about it.
struct Error {
  ErrorKind kind = ErrorKind::input;
  std::string message;   ///< one sentence, no full stop, saying what is wrong and what to do
  SourceLocation where;  ///< unknown for errors that have no place in a file
};

enum class Severity { warning, error };

/// A message as it is shown: `file:line:column: error: message`, then the source line and a caret where known.
std::string format_message(Severity severity, const std::string& message, const SourceLocation& where);

inline std::string format_error(const Error& error) {
  return format_message(Severity::error, error.message, error.where);
}

/// A value, or the reason why there is none.
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::in_place_index<0>, std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  /// The value; only when ok().
  T& value() & { return std::get<0>(state_); }
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  /// The error; only when not ok().
  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success, or the reason of the failure.
using Status = Result<std::monostate>;
inline Status success() {
  return std::monostate{};
}

}  // namespace tenon
