#pragma once

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tenon/lang/load.h"

namespace tenon {

/// What became of a scene text.
struct Outcome {
  Result<Model> model;
  Diagnostics diagnostics;

  /// The echoed lines, joined.
  std::string said() const {
    std::string all;
    for (const std::string& line : diagnostics.said()) all += line + '\n';
    return all;
  }
  std::string warnings() const {
    std::string all;
    for (const std::string& line : diagnostics.warnings()) all += line + '\n';
    return all;
  }
};

inline Outcome evaluate(const std::string& text, const LoadOptions& options = {}) {
  Outcome outcome{Model{}, Diagnostics()};
  outcome.model = load_model_text(text, "scene.scad", options, outcome.diagnostics);
  return outcome;
}

/// The evaluated tree as text; the message when there is none.
inline std::string tree_of(const std::string& text, const LoadOptions& options = {}) {
  const Outcome outcome = evaluate(text, options);
  return outcome.model ? print_csg(*outcome.model) : format_error(outcome.model.error());
}

inline std::string error_of(const std::string& text) {
  const Outcome outcome = evaluate(text);
  return outcome.model ? "no error" : format_error(outcome.model.error());
}

inline std::string warnings_of(const std::string& text) {
  const Outcome outcome = evaluate(text);
  EXPECT_TRUE(outcome.model.ok()) << (outcome.model ? "" : format_error(outcome.model.error()));
  return outcome.warnings();
}

}  // namespace tenon
