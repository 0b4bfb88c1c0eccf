#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "scene_arguments.h"
#include "tenon/base/atomic_file.h"

namespace tenon {

namespace {

using Json = nlohmann::ordered_json;

struct InfoCommand {
  SceneArguments scene;
  std::string accel;
  bool json = false;

  Status run() const;
};

// An infinite end is null, for JSON knows no infinity.
Json json_of(const Vec3& v) {
  Json json = Json::array();
  for (int axis = 0; axis < 3; ++axis) json.push_back(std::isfinite(v[axis]) ? Json(v[axis]) : Json());
  return json;
}

/// What `--accel` asks for.
struct StructureFigures {
  std::string accel;
  double build_seconds = 0;
  AcceleratorFigures figures;
};

std::string figures_json(const SceneFigures& figures, const std::optional<StructureFigures>& structure) {
  Json json;
  json["primitives"] = figures.primitives;
  json["primitives_by_kind"] = Json::object();
  for (const auto& [kind, count] : figures.primitives_by_kind) json["primitives_by_kind"][kind] = count;
  json["instances"] = figures.instances;
  json["operations"] = figures.operations;
  json["depth"] = figures.depth;
  json["bounds"] = figures.bounds.is_empty()
                       ? Json()
                       : Json{{"lower", json_of(figures.bounds.lower)}, {"upper", json_of(figures.bounds.upper)}};
  json["tolerance"] = figures.tolerance;
  json["materials"] = figures.materials;
  json["lights"] = figures.lights;
  if (structure) {
    Json& one = json["structure"];
    one["accel"] = structure->accel;
    one["build_seconds"] = structure->build_seconds;
    one["memory_bytes"] = structure->figures.memory_bytes;
    one["boxes"] = structure->figures.boxes;
    one["depth"] = structure->figures.depth;
    for (const auto& [what, value] : structure->figures.details) one["details"][what] = value;
    if (!structure->figures.note.empty()) one["note"] = structure->figures.note;
  }
  return json.dump(2) + '\n';
}

std::string vector_text(const Vec3& v) {
  char text[96];
  std::snprintf(text, sizeof text, "[%g, %g, %g]", v.x, v.y, v.z);
  return text;
}

std::string structure_text(const StructureFigures& structure) {
  char line[96];
  std::string text;
  const auto add = [&](const std::string& what, const char* format, double value) {
    std::snprintf(line, sizeof line, format, value);
    text += "  " + what + ": " + line + '\n';
  };
  text += "structure   " + structure.accel + '\n';
  add("built in seconds", "%.4f", structure.build_seconds);
  add("memory in bytes", "%.0f", static_cast<double>(structure.figures.memory_bytes));
  add("boxes, cells or nodes", "%.0f", static_cast<double>(structure.figures.boxes));
  add("depth", "%.0f", structure.figures.depth);
  for (const auto& [what, value] : structure.figures.details) add(what, "%.0f", value);
  if (!structure.figures.note.empty()) text += "  note: " + structure.figures.note + '\n';
  return text;
}

std::string figures_text(const SceneFigures& figures, const std::optional<StructureFigures>& structure) {
  char tolerance[32];
  std::snprintf(tolerance, sizeof tolerance, "%.3g", figures.tolerance);
  std::string text = "primitives  " + std::to_string(figures.primitives);
  for (std::size_t i = 0; i < figures.primitives_by_kind.size(); ++i) {
    const auto& [kind, count] = figures.primitives_by_kind[i];
    text += (i == 0 ? ": " : ", ") + std::to_string(count) + ' ' + kind;
  }
  if (figures.instances > 0) text += "\ninstances   " + std::to_string(figures.instances);
  text += "\noperations  " + std::to_string(figures.operations);
  text += "\ndepth       " + std::to_string(figures.depth);
  text += "\nbounds      ";
  text += figures.bounds.is_empty() ? "empty"
                                    : vector_text(figures.bounds.lower) + " to " + vector_text(figures.bounds.upper);
  text += "\ntolerance   " + std::string(tolerance);
  text += "\nmaterials   " + std::to_string(figures.materials);
  text += "\nlights      " + std::to_string(figures.lights) + '\n';
  if (structure) text += structure_text(*structure);
  return text;
}

Status InfoCommand::run() const {
  Console console(scene.quiet);
  Result<Model> model = load(scene, console);
  if (!model) return model.error();
  console.progress().begin("compiling " + scene.path);
  const Result<Scene> compiled = compile_scene(std::move(*model), console.diagnostics());
  console.progress().end();
  if (!compiled) return compiled.error();
  const SceneFigures figures = scene_figures(*compiled);
  std::optional<StructureFigures> structure;
  if (!accel.empty()) {
    Result<BuiltAccelerator> built = build_timed(accel, *compiled, nullptr, console);
    if (!built) return built.error();
    structure = StructureFigures{accel, built->seconds, built->accelerator->figures()};
  }
  return write_standard_output(json ? figures_json(figures, structure) : figures_text(figures, structure));
}

}  // namespace

CommandBody add_info_command(CLI::App& command) {
  const auto arguments = std::make_shared<InfoCommand>();
  arguments->scene.add_to(command);
  command.add_option("--accel", arguments->accel, "Build this structure, NAME[:key=value,...], and print its figures");
  command.add_flag("--json", arguments->json, "As a JSON object");
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
