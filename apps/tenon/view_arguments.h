#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tenon/base/error.h"
#include "tenon/scene/view_request.h"

namespace tenon {

/// From where the scene is looked at, as text.
struct ViewArguments {
  std::string camera;
  std::string angles;
  std::optional<double> aperture;
  std::string focus;
  bool fit = false;
  bool orthographic = false;

  void add_to(CLI::App& command);
  /// The arguments again, each after a blank, for the picture's metadata.
  std::string words() const;
};

/// @param aspect  the picture's width over its height
/// @return what the arguments ask for, or a usage error
Result<ViewRequest> plan_view(const ViewArguments& arguments, double aspect);

}  // namespace tenon
