#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tenon/base/error.h"

namespace tenon {

/// The `key=value,...` behind an accelerator's name. Each structure takes the ones it knows; what is left is an error.
class AcceleratorOptions {
 public:
  /// Splits `NAME[:key=value,...]`.
  static Result<AcceleratorOptions> parse(std::string_view spec);

  const std::string& name() const { return name_; }

  /// The number given for `key`, or `fallback`; out of range or not a number is remembered as an error.
  double take_number(std::string_view key, double fallback, double lowest, double highest);
  int take_integer(std::string_view key, int fallback, int lowest, int highest);
  /// The index of the word given for `key` among `words`; 0, the default, when none is given.
  std::size_t take_word(std::string_view key, const std::vector<std::string_view>& words);
  /// `on` or `off`.
  bool take_switch(std::string_view key, bool fallback);

  /// The first error met by the calls above, or that an option was never asked for.
  Status finish() const;

 private:
  struct Option {
    std::string key, value;
    bool taken = false;
  };
  const std::string* take(std::string_view key, std::string_view meaning);
  void fail(std::string_view key, const std::string& value, const std::string& wanted);

  std::string name_;
  std::vector<Option> options_;
  std::vector<std::string> known_;  // what the structure asked for, for the error message
  std::string error_;
};

}  // namespace tenon
