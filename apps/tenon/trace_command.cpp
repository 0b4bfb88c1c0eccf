#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <memory>

#include "commands.h"
#include "ray_file.h"
#include "scene_arguments.h"
#include "tenon/base/atomic_file.h"
#include "tenon/base/parallel_for.h"

namespace tenon {

namespace {

struct TraceCommand {
  SceneArguments scene;
  TracingArguments tracing;
  std::string rays;
  bool all = false;

  Status run() const;
};

// The shortest text that reads back to the same number; JSON has no infinity, so that is null.
void append_number(std::string& out, double value) {
  if (!std::isfinite(value)) {
    out += "null";
    return;
  }
  std::array<char, 32> text{};
  out.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr);
}

void append_vector(std::string& out, const Vec3& v) {
  for (int axis = 0; axis < 3; ++axis) {
    out += axis == 0 ? '[' : ',';
    append_number(out, v[axis]);
  }
  out += ']';
}

void append_hit(std::string& out, const Scene& scene, const Hit& hit) {
  if (!hit.found()) {
    out += "{\"hit\":false}\n";
    return;
  }
  out += "{\"hit\":true,\"t\":";
  append_number(out, hit.t);
  out += ",\"point\":";
  append_vector(out, hit.point);
  out += ",\"normal\":";
  append_vector(out, hit.normal);
  out += hit.entering ? ",\"entering\":true,\"primitive\":\"" : ",\"entering\":false,\"primitive\":\"";
  out += primitive_name(scene, hit.surface.leaf);
  out += "\",\"id\":" + std::to_string(hit.surface.leaf.get()) + "}\n";
}

void append_spans(std::string& out, const std::vector<SolidSpan>& spans) {
  out += "{\"spans\":[";
  for (std::size_t i = 0; i < spans.size(); ++i) {
    out += i == 0 ? "[" : ",[";
    append_number(out, spans[i].t_in);
    out += ',';
    append_number(out, spans[i].t_out);
    out += ']';
  }
  out += "]}\n";
}

// Follows a stretch of the rays on one thread, and writes what they meet.
std::string trace_rays(const TraceableScene& traceable, std::span<const Ray> rays, bool all, TraceContext& context) {
  std::string out;
  if (all) {
    std::vector<SolidSpan> spans;
    for (const Ray& ray : rays) {
      spans.clear();
      RayQuery query;
      query.ray = ray;
      traceable.accelerator->all_spans(query, spans, context);
      append_spans(out, spans);
    }
    return out;
  }
  std::vector<RayQuery> queries(rays.size());
  std::vector<Hit> hits(rays.size());
  for (std::size_t i = 0; i < rays.size(); ++i) queries[i].ray = rays[i];
  traceable.accelerator->first_hits(queries, hits, context);
  for (const Hit& hit : hits) append_hit(out, traceable.scene, hit);
  return out;
}

Status TraceCommand::run() const {
  if (scene.path == "-" && rays == "-") {
    return usage_error("the scene and the rays cannot both come from standard input");
  }
  Console console(scene.quiet);
  const Result<TraceableScene> traceable = prepare(scene, tracing, console);
  if (!traceable) return traceable.error();
  console.progress().begin("reading rays");
  const Result<std::vector<Ray>> read = read_rays(rays);
  if (!read) return read.error();

  // Blocks of rays go to threads; a round of blocks is written in order before the next begins, so that the answers to
  // many rays need not lie in memory.
  constexpr std::size_t block = 1024;
  constexpr std::size_t blocks_per_round = 256;
  const int threads = tracing.thread_count();
  std::vector<std::unique_ptr<TraceContext>> contexts;
  for (int i = 0; i < threads; ++i) contexts.push_back(traceable->accelerator->make_context());
  ProgressCounters& counters = console.progress().counters();
  console.progress().begin("tracing");
  counters.total = read->size();
  std::vector<std::string> answers(blocks_per_round);
  for (std::size_t begin = 0; begin < read->size(); begin += block * blocks_per_round) {
    const std::span<const Ray> round =
        std::span(*read).subspan(begin, std::min(block * blocks_per_round, read->size() - begin));
    const std::size_t blocks = (round.size() - 1) / block + 1;
    parallel_for(blocks, threads, [&](std::size_t i, int worker) {
      const auto part = round.subspan(i * block, std::min(block, round.size() - i * block));
      answers[i] = trace_rays(*traceable, part, all, *contexts[static_cast<std::size_t>(worker)]);
      counters.done += part.size();
      counters.rays += part.size();
    });
    for (std::size_t i = 0; i < blocks; ++i) {
      if (Status status = write_standard_output(answers[i]); !status) return status;
    }
  }
  return success();
}

}  // namespace

CommandBody add_trace_command(CLI::App& command) {
  const auto arguments = std::make_shared<TraceCommand>();
  arguments->scene.add_to(command);
  command.add_option("--rays", arguments->rays, "The rays, one a line: ox oy oz dx dy dz; - reads standard input")
      ->type_name("FILE")
      ->required();
  command.add_flag("--all", arguments->all, "Every stretch inside the solid instead of the first hit");
  arguments->tracing.add_to(command);
  command.footer(
      accelerator_help() +
      "\n\n"
      "Answers "
      "{\"hit\":true,\"t\":...,\"point\":[...],\"normal\":[...],\"entering\":true,\"primitive\":\"sphere\",\"id\":7} "
      "or\n"
      "{\"hit\":false}; with --all {\"spans\":[[t_in,t_out],...]}, where null is an end at infinity. In the file of "
      "rays,\n"
      "blank lines and what follows a # are passed over.");
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
