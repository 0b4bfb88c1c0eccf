#include "statistics_json.h"

#include <nlohmann/json.hpp>

namespace tenon {

namespace {

using Json = nlohmann::ordered_json;

void add_counters(Json& json, const TraversalCounters& counters) {
  json["primitive_tests"] = counters.primitive_tests;
  json["cells_visited"] = counters.cells_visited;
  json["next_box_calls"] = counters.next_box_calls;
  json["mailbox_hits"] = counters.mailbox_hits;
}

}  // namespace

std::string statistics_json(const std::string& accelerator, const TraceableScene& traceable,
                            const Rendering& rendering) {
  const AcceleratorFigures figures = traceable.accelerator->figures();
  const TraversalCounters total = rendering.statistics.total();
  Json json;
  json["accel"] = accelerator;
  json["threads"] = rendering.threads;
  json["build_seconds"] = traceable.build_seconds;
  json["memory_bytes"] = figures.memory_bytes;
  json["render_seconds"] = rendering.seconds;
  for (std::size_t i = 0; i < ray_kind_count; ++i) {
    json["rays"][std::string(ray_kind_names[i])] = rendering.statistics.by_kind[i].rays;
  }
  json["rays_per_second"] = rendering.seconds > 0 ? static_cast<double>(total.rays) / rendering.seconds : 0.0;
  add_counters(json, total);
  for (std::size_t i = 0; i < ray_kind_count; ++i) {
    add_counters(json["per_kind"][std::string(ray_kind_names[i])], rendering.statistics.by_kind[i]);
  }
  json["boxes"] = figures.boxes;
  json["depth"] = figures.depth;
  json["seam_faults"] = rendering.statistics.seam_faults;
  json["mismatches"] = nullptr;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace tenon
