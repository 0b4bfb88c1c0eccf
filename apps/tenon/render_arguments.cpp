#include "render_arguments.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>

#include "commands.h"
#include "numbers.h"
#include "scene_arguments.h"
#include "tenon/render/film.h"

namespace tenon {

namespace {

constexpr int max_side = 65535;

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

Status read_size(const std::string& text, RenderPlan& plan) {
  const std::size_t x = text.find('x');
  const auto width = parse_number<int>(std::string_view(text).substr(0, x));
  const auto height = x == std::string::npos ? std::nullopt : parse_number<int>(std::string_view(text).substr(x + 1));
  if (!width || !height || *width < 1 || *height < 1 || *width > max_side || *height > max_side) {
    return usage_error("--size takes WIDTHxHEIGHT in pixels, each from 1 to " + std::to_string(max_side) +
                       ", such as 640x480, not '" + text + "'");
  }
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  const double needed = Film::bytes(*width, *height);
  if (needed > memory) {
    return usage_error("a picture of " + text + " takes " + gigabytes(needed) + ", and this machine has " +
                       gigabytes(memory) + "; make --size smaller");
  }
  plan.width = *width;
  plan.height = *height;
  return success();
}

// A device or a pipe has no suffix to go by; it gets what standard output gets.
bool is_device(const std::string& path) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

Status read_output(const RenderArguments& arguments, const std::string& scene_stem, RenderPlan& plan) {
  plan.output = arguments.output;
  if (plan.output.empty()) {
    if (scene_stem.empty())
      return usage_error("a scene from standard input has no name; say with -o where the picture goes");
    plan.output = scene_stem + ".png";
  }
  if (plan.output != "-") {
    auto format = picture_format(plan.output);
    if (!format && is_device(plan.output)) format = PictureFormat::png;
    if (!format) {
      return usage_error("the suffix of '" + plan.output + "' names no picture format; there are: " +
                         std::string(picture_suffixes()) + " (and -o - for a PNG on standard output)");
    }
    plan.format = *format;
  } else if (arguments.statistics == "-") {
    return usage_error("the picture and the statistics cannot both go to standard output");
  }
  const bool is_png = plan.format == PictureFormat::png;
  plan.bits = arguments.bits != 0 ? arguments.bits : is_png ? 8 : 16;
  if (plan.bits != 16 && plan.bits != (is_png ? 8 : 32)) {
    return usage_error(is_png ? "--bits is 8 or 16 for a PNG picture" : "--bits is 16 or 32 for an EXR picture");
  }
  return success();
}

}  // namespace

void RenderArguments::add_to(CLI::App& command) {
  command
      .add_option("-o,--output", output,
                  "The picture: a name that ends in .png or .exr; - writes a PNG to standard output. Otherwise the "
                  "scene's name with .png, in the current folder")
      ->type_name("FILE");
  command.add_option("--size", size, "The picture's width and height in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  command
      .add_option("--integrator", integrator, "How light is followed: whitted (the course's illumination model), path")
      ->type_name("NAME")
      ->capture_default_str();
  command.add_option("--spp", samples, "Samples for each pixel; 1: its centre")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 65536).description("1 to 65536"));
  command
      .add_option("--depth", depth,
                  "Levels of the tree of rays, or surfaces along a path; 1: nothing is reflected or refracted. "
                  "8 by whitted, 20 by path")
      ->type_name("N")
      ->check(CLI::Range(1, 1000).description("1 to 1000"));
  command.add_option("--seed", seed, "Of everything that --integrator path draws at random")
      ->type_name("N")
      ->capture_default_str();
  view.add_to(command);
  command.add_option("--bits", bits, "Bits of each component: 8 or 16 for PNG (8), 16 or 32 for EXR (16)")
      ->type_name("N");
  command
      .add_option("--stats", statistics, "Write what was counted and measured to a JSON file; - for standard output")
      ->type_name("FILE");
  command.footer(
      accelerator_help() +
      "\n\n"
      "--stats writes accel, threads, build_seconds, memory_bytes, render_seconds, rays (by kind), rays_per_second,\n"
      "primitive_tests, cells_visited, next_box_calls and mailbox_hits (over all rays), per_kind (the same four for "
      "each\n"
      "kind of ray), boxes, depth (of the structure), seam_faults, and mismatches (null: a picture alone is compared\n"
      "with nothing).");
}

Result<RenderPlan> plan_render(const RenderArguments& arguments, const std::string& scene_stem) {
  RenderPlan plan;
  if (arguments.integrator == "path") {
    plan.integrator = IntegratorKind::path;
  } else if (arguments.integrator != "whitted") {
    return usage_error("there is no integrator '" + arguments.integrator + "'; there are: whitted, path");
  }
  const bool is_path = plan.integrator == IntegratorKind::path;
  plan.depth = arguments.depth != 0 ? arguments.depth : is_path ? 20 : 8;
  if (Status status = read_size(arguments.size, plan); !status) return status.error();
  Result<ViewRequest> view = plan_view(arguments.view, static_cast<double>(plan.width) / plan.height);
  if (!view) return view.error();
  plan.view = *view;
  if (Status status = read_output(arguments, scene_stem, plan); !status) return status.error();
  return plan;
}

}  // namespace tenon
