#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "lang/format.h"

namespace tenon::lang {

namespace {

constexpr int precision = 6;
constexpr int smallest_plain_exponent = -5;

// The decimal digits of a positive number, rounded to `precision` of them, ties away from zero (printf breaks exact
// ties to even, OpenSCAD does not), and the exponent of the first digit.
std::string rounded_digits(double number, int& exponent) {
  std::array<char, 64> text{};
  // 40 digits tell a tie from a neighbour: a double has 53 bits, so a remainder that small is none.
  std::snprintf(text.data(), text.size(), "%.40e", number);
  std::string digits(1, text[0]);
  digits.append(text.data() + 2, 40);
  exponent = std::atoi(text.data() + 43);
  const bool up = digits[precision] >= '5';
  digits.resize(precision);
  if (!up) return digits;
  for (std::size_t i = precision; i-- > 0;) {
    if (digits[i] != '9') {
      ++digits[i];
      return digits;
    }
    digits[i] = '0';
  }
  ++exponent;
  return "1" + digits.substr(1);
}

// A list may hold one long string many times over, so that its text is far longer than what it takes itself.
void check_length(const std::string& out) {
  if (out.size() > Budget::limit) throw BudgetExceeded{"a text is longer than 512 MiB"};
}

void append_value(const Value& value, const SymbolTable& symbols, std::string& out) {
  check_length(out);
  if (const double* d = value.number()) {
    out += format_number(*d);
  } else if (const bool* b = value.boolean()) {
    out += *b ? "true" : "false";
  } else if (const String* s = value.string()) {
    out += '"' + s->text() + '"';
  } else if (const List* l = value.list()) {
    out += '[';
    bool first = true;
    for (const Value& item : l->items()) {
      if (!first) out += ", ";
      first = false;
      append_value(item, symbols, out);
    }
    out += ']';
  } else if (const Range* r = value.range()) {
    out += '[' + format_number(r->begin) + " : " + format_number(r->step) + " : " + format_number(r->end) + ']';
  } else if (const Closure* c = value.closure()) {
    out += format_function(*c->definition, symbols);
  } else {
    out += "undef";
  }
}

}  // namespace

std::string format_number(double number) {
  if (std::isnan(number)) return "nan";
  if (std::isinf(number)) return number < 0 ? "-inf" : "inf";
  if (number == 0) return "0";
  int exponent = 0;
  std::string digits = rounded_digits(std::fabs(number), exponent);
  digits.erase(digits.find_last_not_of('0') + 1);
  std::string out = number < 0 ? "-" : "";
  if (exponent < smallest_plain_exponent || exponent >= precision) {
    out += digits.substr(0, 1);
    if (digits.size() > 1) out += '.' + digits.substr(1);
    return out + (exponent < 0 ? "e-" : "e+") + std::to_string(std::abs(exponent));
  }
  if (exponent < 0) return out + "0." + std::string(static_cast<std::size_t>(-exponent - 1), '0') + digits;
  const auto whole = static_cast<std::size_t>(exponent) + 1;
  if (digits.size() <= whole) return out + digits + std::string(whole - digits.size(), '0');
  return out + digits.substr(0, whole) + '.' + digits.substr(whole);
}

std::string format_value(const Value& value, const SymbolTable& symbols) {
  std::string out;
  append_value(value, symbols, out);
  return out;
}

std::string format_text(const Value& value, const SymbolTable& symbols) {
  if (const String* s = value.string()) return s->text();
  return format_value(value, symbols);
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

}  // namespace tenon::lang
