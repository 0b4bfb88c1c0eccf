#include <algorithm>
#include <cstdio>
#include <memory>

#include "commands.h"
#include "render_arguments.h"
#include "scene_arguments.h"
#include "statistics_json.h"
#include "tenon/base/atomic_file.h"
#include "tenon/lang/load.h"
#include "tenon/render/camera_rays.h"
#include "tenon/render/compare.h"

namespace tenon {

namespace {

struct CompareCommand {
  SceneArguments scene;
  std::string accelerators = "all";
  std::string size = "320x240";
  int depth = 5;
  std::size_t scattered = 0;
  bool json = false;

  Status run() const;
};

// Commas stand between structures and between the options of one: what has an equals sign and no name is an option of
// the structure before it.
std::vector<std::string> split_specs(const std::string& text) {
  std::vector<std::string> specs;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string item = text.substr(begin, end - begin);
    const bool option = item.find('=') != std::string::npos && item.find(':') == std::string::npos;
    if (option && !specs.empty()) {
      specs.back() += ',' + item;
    } else {
      specs.push_back(item);
    }
    begin = end + 1;
  }
  return specs;
}

// The structures to compare, `none` first: it judges the others.
Result<std::vector<std::string>> wanted_specs(const std::string& text) {
  std::vector<std::string> specs{"none"};
  if (text == "all") {
    for (const std::string_view name : accelerator_names()) {
      if (name != "none") specs.emplace_back(name);
    }
    return specs;
  }
  for (const std::string& spec : split_specs(text)) {
    if (Status status = check_accelerator(spec); !status) return status.error();
    if (spec != "none") specs.push_back(spec);
  }
  return specs;
}

std::string figure(const char* format, double value) {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::vector<std::string> table_row(const Measurements& m, double oracle_seconds) {
  const TraversalCounters total = m.statistics.total();
  const double rays = std::max(1.0, static_cast<double>(total.rays));
  const auto per_ray = [rays](std::uint64_t count) { return figure("%.2f", static_cast<double>(count) / rays); };
  const double asked = std::max(1.0, static_cast<double>(total.primitive_tests + total.mailbox_hits));
  return {m.accelerator,
          figure("%.3f", m.build_seconds),
          figure("%.0f", static_cast<double>(m.figures.memory_bytes) / 1024),
          std::to_string(m.figures.boxes),
          std::to_string(m.figures.depth),
          figure("%.3f", rays / m.render_seconds / 1e6),
          figure("%.2f", oracle_seconds / m.render_seconds),
          per_ray(total.primitive_tests),
          per_ray(total.cells_visited),
          per_ray(total.next_box_calls),
          figure("%.0f", 100 * static_cast<double>(total.mailbox_hits) / asked),
          std::to_string(m.mismatches.value_or(0))};
}

// Fastest first.
std::string table(const std::vector<Measurements>& all) {
  std::vector<std::vector<std::string>> rows{{"accel", "build s", "KiB", "boxes", "depth", "Mrays/s", "x none",
                                              "tests/ray", "cells/ray", "next/ray", "mailbox %", "mismatches"}};
  std::vector<const Measurements*> order;
  for (const Measurements& m : all) order.push_back(&m);
  std::stable_sort(order.begin(), order.end(),
                   [](const Measurements* a, const Measurements* b) { return a->render_seconds < b->render_seconds; });
  for (const Measurements* m : order) rows.push_back(table_row(*m, all.front().render_seconds));

  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
  }
  std::string text;
  for (const auto& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) {
      const std::string space(widths[i] - row[i].size(), ' ');
      text += i == 0 ? row[i] + space : "  " + space + row[i];
    }
    text += '\n';
  }
  return text;
}

std::string describe(const StoredAnswer& answer, RayKind kind) {
  char text[200];
  if (kind == RayKind::shadow) {
    std::snprintf(text, sizeof text, "%s, %u boundaries passed", answer.stopped ? "stopped" : "not stopped",
                  answer.passed);
  } else if (!answer.hit.found()) {
    return "nothing";
  } else {
    std::snprintf(text, sizeof text, "t %.17g, leaf %u face %u, %s, medium %u to %u, %zu faces", answer.hit.t,
                  answer.hit.surface.leaf.get(), answer.hit.surface.face, answer.hit.entering ? "entering" : "leaving",
                  answer.hit.before, answer.hit.after, answer.hit.faces.size());
  }
  return text;
}

// The ray in the form that `tenon trace` reads.
std::string describe(const std::string& accelerator, const Replay& replay) {
  const Mismatch& m = *replay.first;
  const Ray& ray = m.query.ray;
  char text[400];
  std::snprintf(text, sizeof text,
                "%zu rays of %s differ from none; the first, %s: %.17g %.17g %.17g %.17g %.17g %.17g",
                replay.mismatches, accelerator.c_str(),
                std::string(ray_kind_names[static_cast<std::size_t>(m.query.kind)]).c_str(), ray.origin.x, ray.origin.y,
                ray.origin.z, ray.direction.x, ray.direction.y, ray.direction.z);
  return text + ("; none: " + describe(m.expected, m.query.kind)) + "; " + accelerator + ": " +
         describe(m.found, m.query.kind);
}

Status CompareCommand::run() const {
  RenderArguments picture;
  picture.size = size;
  const Result<RenderPlan> plan = plan_render(picture);
  if (!plan) return plan.error();
  const Result<std::vector<std::string>> specs = wanted_specs(accelerators);
  if (!specs) return specs.error();

  Console console(scene.quiet);
  TracingArguments tracing;
  tracing.accelerator = "none";
  const Result<TraceableScene> traceable = prepare(scene, tracing, console);
  if (!traceable) return traceable.error();
  const Scene& compiled = traceable->scene;
  const Result<CameraRays> camera = CameraRays::create(compiled.camera, plan->width, plan->height);
  if (!camera) return camera.error();
  const ScreenView view = camera->view();

  RenderOptions options;
  options.width = plan->width;
  options.height = plan->height;
  options.depth = depth;
  console.progress().begin("tracing rays with none");
  Result<StoredRays> rays =
      StoredRays::record(compiled, *traceable->accelerator, options, &console.progress().counters());
  if (!rays) return rays.error();
  add_scattered_rays(compiled, *traceable->accelerator, scattered, *rays);

  std::vector<Measurements> all;
  std::string differences;
  for (const std::string& spec : *specs) {
    Result<BuiltAccelerator> built = build_timed(spec, compiled, &view, console);
    if (!built) {
      if (built.error().kind == ErrorKind::usage) return built.error();
      console.progress().say("tenon: " + spec + " is left out: " + built.error().message);
      continue;
    }
    console.progress().begin("tracing rays with " + spec);
    const Replay replayed = replay(compiled, *built->accelerator, *rays, &console.progress().counters());
    console.progress().end();
    all.push_back({spec, 1, built->seconds, replayed.seconds, built->accelerator->figures(), replayed.statistics,
                   std::nullopt, replayed.mismatches});
    if (replayed.mismatches > 0) differences += (differences.empty() ? "" : "\n") + describe(spec, replayed);
  }
  if (Status status = write_standard_output(json ? statistics_json(all) : table(all)); !status) return status;
  if (!differences.empty()) return Error{ErrorKind::input, differences, {}};
  return success();
}

}  // namespace

CommandBody add_compare_command(CLI::App& command) {
  const auto arguments = std::make_shared<CompareCommand>();
  arguments->scene.add_to(command);
  command.add_option("--accel", arguments->accelerators, "The structures, with commas between them, or all")
      ->type_name("NAME,...|all")
      ->capture_default_str();
  command.add_option("--size", arguments->size, "Size of the picture whose rays are traced")
      ->type_name("WxH")
      ->capture_default_str();
  command.add_option("--depth", arguments->depth, "Levels of the tree of rays; 1: nothing is reflected or refracted")
      ->type_name("N")
      ->capture_default_str()
      ->check(CLI::Range(1, 1000).description("1 to 1000"));
  command
      .add_option("--scattered", arguments->scattered, "Trace this many rays from anywhere in and around the scene too")
      ->type_name("N")
      ->capture_default_str();
  command.add_flag("--json", arguments->json, "Print JSON in place of a table, the structures in the order given");
  command.footer(accelerator_help() +
                 "\n\n"
                 "Builds each structure and traces through it, on one thread, the primary, shadow, reflected and\n"
                 "refracted rays of the picture, checking every answer against none. Scattered rays count as diffuse "
                 "ones. Exit status 1 when one differs.");
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
