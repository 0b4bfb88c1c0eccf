#include "lang/color_value.h"

#include <cmath>
#include <string>

namespace tenon::lang {

namespace {

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  return -1;
}

// Digits without the '#'.
std::optional<Rgba> hex_color(std::string_view digits) {
  const std::size_t n = digits.size();
  if (n != 3 && n != 4 && n != 6 && n != 8) return std::nullopt;
  const std::size_t per_component = n < 6 ? 1 : 2;
  double components[4] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < n / per_component; ++i) {
    const int high = hex_digit(digits[i * per_component]);
    const int low = hex_digit(digits[i * per_component + per_component - 1]);
    if (high < 0 || low < 0) return std::nullopt;
    components[i] = (high * 16 + low) / 255.0;
  }
  return Rgba{components[0], components[1], components[2], components[3]};
}

std::optional<Rgba> color_from_text(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text.starts_with('#') ? hex_color(std::string_view(text).substr(1)) : named_color(text);
}

}  // namespace

std::optional<Rgba> to_color(const Value& value) {
  if (const String* s = value.string()) return color_from_text(s->text());
  const List* list = value.list();
  if (!list || (list->items().size() != 3 && list->items().size() != 4)) return std::nullopt;
  double components[4] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < list->items().size(); ++i) {
    const double* number = list->items()[i].number();
    if (!number || !std::isfinite(*number)) return std::nullopt;
    components[i] = *number;
  }
  return Rgba{components[0], components[1], components[2], components[3]};
}

}  // namespace tenon::lang
