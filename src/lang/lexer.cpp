#include "lang/lexer.h"

#include <array>
#include <charconv>
#include <cstdio>
#include <limits>
#include <utility>

#include "lang/failure.h"
#include "lang/utf8.h"

namespace tenon::lang {

namespace {

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
bool is_word(char c) {
  return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_';
}
bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f' || c == '\v';
}

constexpr std::array<std::pair<std::string_view, TokenKind>, 12> keywords{{
    {"module", TokenKind::keyword_module},
    {"function", TokenKind::keyword_function},
    {"if", TokenKind::keyword_if},
    {"else", TokenKind::keyword_else},
    {"for", TokenKind::keyword_for},
    {"let", TokenKind::keyword_let},
    {"assert", TokenKind::keyword_assert},
    {"echo", TokenKind::keyword_echo},
    {"each", TokenKind::keyword_each},
    {"true", TokenKind::keyword_true},
    {"false", TokenKind::keyword_false},
    {"undef", TokenKind::keyword_undef},
}};

// How many bytes of `text` a number takes: digits with a point anywhere, then an exponent if it has digits.
std::size_t number_length(std::string_view text) {
  std::size_t i = 0;
  std::size_t digits = 0;
  while (i < text.size() && is_digit(text[i])) ++i, ++digits;
  if (i < text.size() && text[i] == '.') {
    ++i;
    while (i < text.size() && is_digit(text[i])) ++i, ++digits;
  }
  if (digits == 0) return 0;
  if (i < text.size() && (text[i] == 'e' || text[i] == 'E')) {
    std::size_t e = i + 1;
    if (e < text.size() && (text[e] == '+' || text[e] == '-')) ++e;
    if (e < text.size() && is_digit(text[e])) {
      while (e < text.size() && is_digit(text[e])) ++e;
      return e;
    }
  }
  return i;
}

std::size_t word_length(std::string_view text) {
  std::size_t i = text.front() == '$' ? 1 : 0;
  while (i < text.size() && is_word(text[i])) ++i;
  return i;
}

// from_chars reports what is too large or too small without a value; the language says infinity and zero.
double parse_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    const std::size_t e = text.find_first_of("eE");
    const bool tiny = e != std::string_view::npos && text.substr(e).find('-') != std::string_view::npos;
    return tiny ? 0 : std::numeric_limits<double>::infinity();
  }
  return value;
}

}  // namespace

std::string describe(const Token& token) {
  switch (token.kind) {
    case TokenKind::end:
      return "the end of the file";
    case TokenKind::string:
      return "a string";
    case TokenKind::use:
    case TokenKind::include:
      return "'" + std::string(token.text.substr(0, token.text.find_first_of(" <"))) + "'";
    default:
      return "'" + std::string(token.text) + "'";
  }
}

Lexer::Lexer(const SourceText& source) : source_(&source) {
  if (source.text.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

char Lexer::peek(std::size_t ahead) const {
  return at_ + ahead < source_->text.size() ? source_->text[at_ + ahead] : '\0';
}

Place Lexer::place(std::size_t offset) const {
  return {source_, static_cast<std::uint32_t>(offset)};
}

Token Lexer::token(TokenKind kind, std::size_t begin) const {
  return {kind, place(begin), std::string_view(source_->text).substr(begin, at_ - begin), {}, 0};
}

void Lexer::skip_blanks_and_comments() {
  const std::string& text = source_->text;
  for (;;) {
    while (at_ < text.size() && is_blank(text[at_])) ++at_;
    // No-break spaces arrive with scenes copied from web pages.
    if (text.compare(at_, 2, "\xC2\xA0") == 0) {
      at_ += 2;
    } else if (text.compare(at_, 2, "//") == 0) {
      while (at_ < text.size() && text[at_] != '\n') ++at_;
    } else if (text.compare(at_, 2, "/*") == 0) {
      const std::size_t end = text.find("*/", at_ + 2);
      if (end == std::string::npos) fail(place(at_), "this comment never ends; close it with */");
      at_ = end + 2;
    } else {
      return;
    }
  }
}

Token Lexer::next() {
  skip_blanks_and_comments();
  if (at_ >= source_->text.size()) return token(TokenKind::end, at_);
  const char c = peek();
  if (c == '"') return string();
  if (is_word(c) || c == '$' || (c == '.' && is_digit(peek(1)))) return word_or_number();
  return symbol();
}

Token Lexer::word_or_number() {
  const std::size_t begin = at_;
  const std::string_view rest = std::string_view(source_->text).substr(at_);
  // The longer wins, as in OpenSCAD: 0x10 is a name, 1e3 is a number.
  const std::size_t number = number_length(rest);
  const std::size_t word = word_length(rest);
  if (number >= word && number > 0) {
    at_ += number;
    Token t = token(TokenKind::number, begin);
    t.number = parse_number(t.text);
    return t;
  }
  at_ += word;
  Token t = token(TokenKind::identifier, begin);
  for (const auto& [spelling, kind] : keywords) {
    if (t.text == spelling) t.kind = kind;
  }
  if (t.text == "use" || t.text == "include") {
    const std::size_t after_word = at_;
    while (is_blank(peek())) ++at_;
    if (peek() == '<') return file_name(t.text == "use" ? TokenKind::use : TokenKind::include, begin);
    at_ = after_word;
  }
  if (t.text == "$") fail(t.at, "a name must follow '$'");
  return t;
}

Token Lexer::file_name(TokenKind kind, std::size_t begin) {
  const std::size_t end = source_->text.find_first_of(">\n", at_ + 1);
  if (end == std::string::npos || source_->text[end] != '>') {
    fail(place(at_), "this file name never ends; close it with >");
  }
  std::string name = source_->text.substr(at_ + 1, end - at_ - 1);
  at_ = end + 1;
  Token t = token(kind, begin);
  t.string = std::move(name);
  return t;
}

Token Lexer::string() {
  const std::size_t begin = at_++;
  std::string value;
  for (;;) {
    if (at_ >= source_->text.size()) fail(place(begin), "this string never ends; close it with \"");
    const char c = peek();
    if (c == '"') break;
    if (c == '\\') {
      escape(value);
    } else {
      value += c;
      ++at_;
    }
  }
  ++at_;
  Token t = token(TokenKind::string, begin);
  t.string = std::move(value);
  return t;
}

// What OpenSCAD does not know as an escape stands for itself, without the backslash.
void Lexer::escape(std::string& value) {
  ++at_;
  const char c = peek();
  switch (c) {
    case 'n':
      value += '\n';
      break;
    case 't':
      value += '\t';
      break;
    case 'r':
      value += '\r';
      break;
    case 'x':
      return code_point_escape(2, value);
    case 'u':
      return code_point_escape(4, value);
    case 'U':
      return code_point_escape(6, value);
    case '\0':
      return;
    default:
      value += c;
  }
  ++at_;
}

void Lexer::code_point_escape(int digits, std::string& value) {
  const char letter = peek();
  std::uint32_t code = 0;
  const char* first = source_->text.data() + at_ + 1;
  const char* last = first + digits;
  const bool fits = at_ + 1 + static_cast<std::size_t>(digits) <= source_->text.size();
  const bool complete = fits && std::from_chars(first, last, code, 16).ptr == last;
  ++at_;
  // \x stops at 7F in the language.
  if (!complete || (digits == 2 && code > 0x7F)) {
    value += letter;
    return;
  }
  if (!append_utf8(code, value)) value += ' ';
  at_ += static_cast<std::size_t>(digits);
}

Token Lexer::symbol() {
  const std::size_t begin = at_;
  for (const std::string_view pair : {"<=", ">=", "==", "!=", "&&", "||"}) {
    if (source_->text.compare(at_, 2, pair) == 0) {
      at_ += 2;
      return token(TokenKind::symbol, begin);
    }
  }
  constexpr std::string_view single = "()[]{}<>=+-*/%^!?:;,.#";
  if (single.find(peek()) == std::string_view::npos) {
    const auto byte = static_cast<unsigned char>(peek());
    std::array<char, 64> message{};
    if (byte > 0x20 && byte < 0x7F) {
      std::snprintf(message.data(), message.size(), "the character '%c' means nothing here; remove it", peek());
    } else {
      std::snprintf(message.data(), message.size(), "the byte 0x%02X means nothing here; remove it", byte);
    }
    fail(place(at_), message.data());
  }
  ++at_;
  return token(TokenKind::symbol, begin);
}

}  // namespace tenon::lang
