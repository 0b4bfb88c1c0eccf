#include "render_arguments.h"

#include "commands.h"
#include "numbers.h"
#include "scene_arguments.h"

namespace tenon {

namespace {

constexpr int max_side = 65535;

Status read_size(const std::string& text, RenderPlan& plan) {
  const std::size_t x = text.find('x');
  const auto width = parse_number<int>(std::string_view(text).substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number<int>(std::string_view(text).substr(x + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > max_side || *height > max_side) {
    return usage_error("--size takes WIDTHxHEIGHT in pixels, each from 1 to " + std::to_string(max_side) +
                       ", such as 640x480, not '" + text + "'");
  }
  plan.width = *width;
  plan.height = *height;
  return success();
}

}  // namespace

void RenderArguments::add_to(CLI::App& command) {
  command.add_option("--size", size, "The picture's width and height in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command
      .add_option("--integrator", integrator, "How light is followed: whitted (the course's illumination model), path")
      ->type_name("NAME")
      ->capture_default_str();
  command
      .add_option("--depth", depth,
                  "Levels of the tree of rays, or surfaces along a path; 1: nothing is reflected or refracted. "
                  "8 by whitted, 20 by path, which says when light may be missed by that")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description("1 to 1000"));
  command.add_option("--seed", seed, "Of everything that --integrator path draws at random")
      ->type_name("N")
      ->capture_default_str();
  view.add_to(command);
  command.add_flag("--transparent", transparent,
                   "Leave the background out: alpha says how much of each pixel the solids cover");
  section_style.add_to(command);
  command
      .add_option("--stats", statistics, "Write what was counted and measured to a JSON file; - for standard output")
      ->type_name("FILE");
  command.footer(
      accelerator_help() +
      "\n\n"
      "--stats writes accel, threads, build_seconds, memory_bytes, render_seconds, rays (by kind), rays_per_second,\n"
      "primitive_tests, cells_visited, next_box_calls and mailbox_hits (over all rays), per_kind (the same four for "
      "each\n"
      "kind of ray), boxes, depth (of the structure), seam_faults, paths_cut (by --depth), share_cut (of the light, "
      "as\n"
      "it falls off along paths), and mismatches (null: a picture alone is compared with nothing).");
}

Result<RenderPlan> plan_render(const RenderArguments& arguments) {
  RenderPlan plan;
  if (arguments.integrator == "path") {
    plan.integrator = IntegratorKind::path;
  } else if (arguments.integrator != "whitted") {
    return usage_error("there is no integrator '" + arguments.integrator + "'; there are: whitted, path");
  }
  const bool is_path = plan.integrator == IntegratorKind::path;
  plan.depth = arguments.depth != 0 ? arguments.depth : is_path ? usual_path_depth : 8;
  if (Status status = read_size(arguments.size, plan); !status) return status.error();
  Result<ViewRequest> view = plan_view(arguments.view, static_cast<double>(plan.width) / plan.height);
  if (!view) return view.error();
  plan.view = *view;
  plan.view.keeps_light = arguments.section_style.light == "keep";
  const Result<std::optional<HatchOptions>> hatch = plan_hatch(arguments.section_style);
  if (!hatch) return hatch.error();
  plan.hatch = *hatch;
  return plan;
}

}  // namespace tenon
