#include "accel/options.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

std::string number_text(double value) {
  char buffer[32];
  const auto [end, code] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

}  // namespace

Result<AcceleratorOptions> AcceleratorOptions::parse(std::string_view spec) {
  AcceleratorOptions options;
  const std::size_t colon = spec.find(':');
  options.name_ = spec.substr(0, colon);
  if (colon == std::string_view::npos) return options;
  std::string_view rest = spec.substr(colon + 1);
  while (!rest.empty()) {
    const std::size_t comma = rest.find(',');
    const std::string_view item = rest.substr(0, comma);
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
    const std::size_t equals = item.find('=');
    if (equals == std::string_view::npos || equals == 0) {
      return Error{ErrorKind::usage, "accelerator option '" + std::string(item) + "' is not of the form key=value", {}};
    }
    options.options_.push_back({std::string(item.substr(0, equals)), std::string(item.substr(equals + 1))});
  }
  return options;
}

const std::string* AcceleratorOptions::take(std::string_view key, std::string_view meaning) {
  known_.push_back(std::string(key) + '=' + std::string(meaning));
  const std::string* value = nullptr;
  for (Option& o : options_) {
    if (o.key == key) {
      o.taken = true;
      value = &o.value;
    }
  }
  return value;
}

void AcceleratorOptions::fail(std::string_view key, const std::string& value, const std::string& wanted) {
  if (!error_.empty()) return;
  error_ = "accelerator option " + std::string(key) + "=" + value + ": expected " + wanted;
}

double AcceleratorOptions::take_number(std::string_view key, double fallback, double lowest, double highest) {
  const std::string* text = take(key, "NUMBER");
  if (text == nullptr) return fallback;
  double value = 0;
  const auto [end, code] = std::from_chars(text->data(), text->data() + text->size(), value);
  if (code != std::errc{} || end != text->data() + text->size() || !(value >= lowest && value <= highest)) {
    fail(key, *text, "a number from " + number_text(lowest) + " to " + number_text(highest));
    return fallback;
  }
  return value;
}

int AcceleratorOptions::take_integer(std::string_view key, int fallback, int lowest, int highest) {
  const double value = take_number(key, fallback, lowest, highest);
  if (value != std::floor(value)) {
    fail(key, number_text(value), "a whole number");
    return fallback;
  }
  return static_cast<int>(value);
}

std::size_t AcceleratorOptions::take_word(std::string_view key, const std::vector<std::string_view>& words) {
  std::string all;
  for (const std::string_view w : words) all += (all.empty() ? "" : "|") + std::string(w);
  const std::string* text = take(key, all);
  if (text == nullptr) return 0;
  const auto found = std::find(words.begin(), words.end(), *text);
  if (found == words.end()) {
    fail(key, *text, "one of " + all);
    return 0;
  }
  return static_cast<std::size_t>(found - words.begin());
}

bool AcceleratorOptions::take_switch(std::string_view key, bool fallback) {
  const std::size_t word = fallback ? take_word(key, {"on", "off"}) : take_word(key, {"off", "on"});
  return (word == 0) == fallback;
}

Status AcceleratorOptions::finish() const {
  if (!error_.empty()) return Error{ErrorKind::usage, error_, {}};
  for (const Option& o : options_) {
    if (o.taken) continue;
    std::string known;
    for (const std::string& k : known_) known += (known.empty() ? "" : ", ") + k;
    return Error{ErrorKind::usage,
                 "accelerator '" + name_ + "' has no option '" + o.key + "'; " +
                     (known.empty() ? "it has none" : "it has " + known),
                 {}};
  }
  return success();
}

}  // namespace tenon
