#pragma once

#include <string>
#include <string_view>

#include "lang/source_text.h"

namespace tenon::lang {

enum class TokenKind {
  end,
  identifier,
  number,
  string,
  use,      ///< `use <file>`; the text is the file's name
  include,  ///< `include <file>`
  keyword_module,
  keyword_function,
  keyword_if,
  keyword_else,
  keyword_for,
  keyword_let,
  keyword_assert,
  keyword_echo,
  keyword_each,
  keyword_true,
  keyword_false,
  keyword_undef,
  symbol,  ///< an operator or a bracket; the text says which
};

struct Token {
  TokenKind kind = TokenKind::end;
  Place at;
  std::string_view text;  ///< as written
  std::string string;     ///< the value of a string, or the name of a file
  double number = 0;

  bool is(std::string_view spelling) const { return kind == TokenKind::symbol && text == spelling; }
};

/// A token as a message names it.
std::string describe(const Token& token);

}  // namespace tenon::lang
