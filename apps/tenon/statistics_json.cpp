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

Json to_json(const Measurements& m) {
  const TraversalCounters total = m.statistics.total();
  Json json;
  json["accel"] = m.accelerator;
  json["threads"] = m.threads;
  json["build_seconds"] = m.build_seconds;
  json["memory_bytes"] = m.figures.memory_bytes;
  json["render_seconds"] = m.render_seconds;
  for (std::size_t i = 0; i < ray_kind_count; ++i) {
    json["rays"][std::string(ray_kind_names[i])] = m.statistics.by_kind[i].rays;
  }
  json["rays_per_second"] = m.render_seconds > 0 ? static_cast<double>(total.rays) / m.render_seconds : 0.0;
  add_counters(json, total);
  for (std::size_t i = 0; i < ray_kind_count; ++i) {
    add_counters(json["per_kind"][std::string(ray_kind_names[i])], m.statistics.by_kind[i]);
  }
  json["boxes"] = m.figures.boxes;
  json["depth"] = m.figures.depth;
  json["seam_faults"] = m.statistics.seam_faults;
  json["paths_cut"] = m.cut ? Json(m.cut->paths) : Json(nullptr);
  json["share_cut"] = m.cut ? Json(m.cut->share) : Json(nullptr);
  json["mismatches"] = m.mismatches ? Json(*m.mismatches) : Json(nullptr);
  return json;
}

std::string to_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string statistics_json(const std::string& accelerator, const TraceableScene& traceable, int threads,
                            double render_seconds, const TraversalStatistics& statistics,
                            const std::optional<DepthCut>& cut) {
  return to_text(to_json({accelerator, threads, traceable.build_seconds, render_seconds,
                          traceable.accelerator->figures(), statistics, cut, std::nullopt}));
}

std::string statistics_json(std::span<const Measurements> all) {
  Json json = Json::array();
  for (const Measurements& m : all) json.push_back(to_json(m));
  return to_text(json);
}

}  // namespace tenon
