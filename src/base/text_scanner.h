#pragma once

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "tenon/base/error.h"

namespace tenon {

/// Reads words and numbers from text, and knows where it is.
class TextScanner {
 public:
  TextScanner(const std::string& path, std::string_view text) : path_(path), text_(text) {}

  bool at_end() const { return position_ >= text_.size(); }
  std::size_t position() const { return position_; }

  /// The next line, without its end; false at the end of the text. A `\r` before the end belongs to the end.
  bool next_line() {
    if (next_ >= text_.size()) return false;
    line_begin_ = position_ = next_;
    const std::size_t end = text_.find('\n', next_);
    line_end_ = end == std::string_view::npos ? text_.size() : end;
    next_ = end == std::string_view::npos ? text_.size() : end + 1;
    if (line_end_ > line_begin_ && text_[line_end_ - 1] == '\r') --line_end_;
    ++line_;
    return true;
  }
  /// Where the text behind the current line begins.
  std::size_t behind_line() const { return next_; }

  /// The next word of the line; empty at its end.
  std::string_view word() {
    while (position_ < line_end_ && is_space(text_[position_])) ++position_;
    word_ = position_;
    while (position_ < line_end_ && !is_space(text_[position_])) ++position_;
    return text_.substr(word_, position_ - word_);
  }
  /// What is left of the line, without spaces around it.
  std::string_view rest() {
    while (position_ < line_end_ && is_space(text_[position_])) ++position_;
    word_ = position_;
    position_ = line_end_;
    std::size_t end = line_end_;
    while (end > word_ && is_space(text_[end - 1])) --end;
    return text_.substr(word_, end - word_);
  }
  int line() const { return line_; }

  /// The next word, on this line or a later one; empty at the end of the text.
  std::string_view word_across_lines() {
    for (;;) {
      if (const std::string_view found = line_ > 0 ? word() : std::string_view{}; !found.empty()) return found;
      if (!next_line()) return {};
    }
  }
  /// The next line with anything on it before a `#`; false at the end of the text.
  bool next_content_line() {
    while (next_line()) {
      const std::size_t comment = text_.substr(line_begin_, line_end_ - line_begin_).find('#');
      if (comment != std::string_view::npos) line_end_ = line_begin_ + comment;
      const std::size_t begin = position_;
      const bool has_content = !word().empty();
      position_ = begin;
      if (has_content) return true;
    }
    return false;
  }

  /// An error at the last word.
  Error error(const std::string& message) const {
    std::size_t end = text_.find('\n', line_begin_);
    if (end == std::string_view::npos) end = text_.size();
    return Error{ErrorKind::input,
                 message,
                 {path_, line_, static_cast<int>(std::max(word_, line_begin_) - line_begin_) + 1,
                  printable(text_.substr(line_begin_, end - line_begin_))}};
  }

  /// A word as messages may show it.
  static std::string printable(std::string_view text) {
    std::string shown(text.substr(0, 2000));
    for (char& c : shown) {
      if (static_cast<unsigned char>(c) < 32 || static_cast<unsigned char>(c) >= 127) c = c == '\t' ? ' ' : '?';
    }
    return shown;
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v'; }

  const std::string& path_;
  std::string_view text_;
  std::size_t position_ = 0, next_ = 0, line_begin_ = 0, line_end_ = 0, word_ = 0;
  int line_ = 0;
};

/// A finite number; nothing when the word is none.
inline std::optional<double> to_number(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  double value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  // What is too small for a double is the nearest there is; what is too large is none. from_chars tells them not apart.
  if (problem == std::errc::result_out_of_range && end == word.data() + word.size()) {
    value = std::strtod(std::string(word).c_str(), nullptr);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
  }
  if (problem != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

inline std::optional<long long> to_integer(std::string_view word) {
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  long long value = 0;
  const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (problem != std::errc() || end != word.data() + word.size()) return std::nullopt;
  return value;
}

}  // namespace tenon
