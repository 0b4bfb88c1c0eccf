#pragma once

#include "lang/token.h"

namespace tenon::lang {

/// Cuts one file into tokens.
class Lexer {
 public:
  explicit Lexer(const SourceText& source);
  Token next();

 private:
  char peek(std::size_t ahead = 0) const;
  Place place(std::size_t offset) const;
  void skip_blanks_and_comments();
  Token token(TokenKind kind, std::size_t begin) const;
  Token word_or_number();
  Token string();
  void escape(std::string& value);
  void code_point_escape(int digits, std::string& value);
  Token file_name(TokenKind kind, std::size_t begin);
  Token symbol();

  const SourceText* source_;
  std::size_t at_ = 0;
};

}  // namespace tenon::lang
