#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/render/hatch.h"
#include "tenon/scene/section.h"

namespace tenon {

/// `--cut`, the planes of a section view.
struct SectionArguments {
  std::vector<std::string> cuts;

  void add_to(CLI::App& command);
};

/// How a picture shows its section view.
struct SectionStyleArguments {
  std::string light = "remove";
  bool hatch = false;
  double angle = HatchOptions{}.angle;
  std::string spacing;

  void add_to(CLI::App& command);
  /// The arguments again, each after a blank, for the picture's metadata.
  std::string words() const;
};

/// @return none without `--hatch`; or a usage error
Result<std::optional<HatchOptions>> plan_hatch(const SectionStyleArguments& arguments);

/// @return a cut for each `--cut`, or a usage error
Result<std::vector<SectionCut>> parse_cuts(const SectionArguments& arguments);

}  // namespace tenon
