#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "tenon/base/error.h"

namespace tenon {

/// What is said on the way without stopping: warnings, and the lines a scene prints with `echo`.
///
/// Messages are kept, and also handed to `sink` at once when one is set, so that a long evaluation speaks as it goes.
class Diagnostics {
 public:
  using Sink = std::function<void(const std::string& line)>;

  Diagnostics() = default;
  explicit Diagnostics(Sink sink) : sink_(std::move(sink)) {}

  void warn(const std::string& message, const SourceLocation& where = {}) {
    warnings_.push_back(format_message(Severity::warning, message, where));
    if (sink_) sink_(warnings_.back());
  }
  /// A line of the scene's own, such as `ECHO: 1`.
  void say(const std::string& line) {
    said_.push_back(line);
    if (sink_) sink_(line);
  }

  const std::vector<std::string>& warnings() const { return warnings_; }
  const std::vector<std::string>& said() const { return said_; }

 private:
  Sink sink_;
  std::vector<std::string> warnings_;
  std::vector<std::string> said_;
};

}  // namespace tenon
