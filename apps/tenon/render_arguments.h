#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "section_arguments.h"
#include "tenon/base/error.h"
#include "tenon/render/renderer.h"
#include "view_arguments.h"

namespace tenon {

/// What `tenon render` is told beyond the scene, as text.
struct RenderArguments {
  std::string size = "640x480";
  std::string integrator = "whitted";
  ViewArguments view;
  SectionStyleArguments section_style;
  std::string statistics;
  int depth = 0;
  std::uint64_t seed = 0;
  bool transparent = false;

  void add_to(CLI::App& command);
};

/// Surfaces along a path where nobody says how many, as in Zajíček's thesis.
inline constexpr int usual_path_depth = 20;

/// The same, understood.
struct RenderPlan {
  int width = 0, height = 0;
  IntegratorKind integrator = IntegratorKind::whitted;
  int depth = 8;
  ViewRequest view;
  std::optional<HatchOptions> hatch;
};

/// @return the plan, or a usage error
Result<RenderPlan> plan_render(const RenderArguments& arguments);

}  // namespace tenon
