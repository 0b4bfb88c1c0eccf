#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/scene/section.h"

namespace tenon {

/// `--cut`, the planes of a section view.
struct SectionArguments {
  std::vector<std::string> cuts;

  void add_to(CLI::App& command);
};

/// @return a cut for each `--cut`, or a usage error
Result<std::vector<SectionCut>> parse_cuts(const SectionArguments& arguments);

}  // namespace tenon
