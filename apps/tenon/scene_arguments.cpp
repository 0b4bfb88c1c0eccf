#include "scene_arguments.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>

#include "commands.h"
#include "model_fingerprint.h"
#include "numbers.h"
#include "tenon/accel/section_light.h"
#include "tenon/base/parallel_for.h"
#include "tenon/image/light_file.h"
#include "tenon/lang/load.h"
#include "tenon/render/camera_rays.h"

namespace tenon {

namespace {

constexpr int max_threads = 4096;

std::optional<int> parse_threads(const std::string& text) {
  if (text == "auto") return available_threads();
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 0 || count > max_threads) return std::nullopt;
  return count == 0 ? available_threads() : count;
}

Result<LoadOptions> load_options(const SceneArguments& arguments) {
  LoadOptions options;
  options.facets = arguments.facets == "always"  ? Facets::always
                   : arguments.facets == "never" ? Facets::never
                                                 : Facets::automatic;
  for (const std::string& definition : arguments.definitions) {
    const std::size_t equals = definition.find('=');
    if (equals == 0 || equals == std::string::npos) {
      return usage_error("-D takes name=value, such as -D size=10, not '" + definition + "'");
    }
    const std::string name = definition.substr(0, equals), value = definition.substr(equals + 1);
    // `$t` is to be there before the file's own assignments look at it; others are put in the place of the file's.
    if (const auto time = parse_number<double>(value); name == "$t" && time) {
      options.time = *time;
    } else {
      options.definitions.emplace_back(name, value);
    }
  }
  return options;
}

}  // namespace

void SceneArguments::add_to(CLI::App& command) {
  command.add_option("SCENE", path, "The scene file, or a mesh file; - reads standard input")
      ->type_name("")
      ->required();
  command.add_option("-D", definitions, "Set a variable of the scene: name=value (may be repeated)")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  command.add_option("--facets", facets, "When $fn makes polygons of round things: auto (below 13), always, never")
      ->type_name("WHEN")
      ->check(CLI::IsMember({"auto", "always", "never"}));
  section.add_to(command);
  command
      .add_option("--cut-faces", cut_faces,
                  "Whose material the faces of a difference show: the tool's, where it was given one, or that of the "
                  "base that was cut")
      ->type_name("WHOSE")
      ->capture_default_str()
      ->check(CLI::IsMember({"tool", "base"}));
  command.add_flag("-q,--quiet", quiet, "Show no progress");
}

std::string SceneArguments::stem() const {
  return path == "-" ? "" : std::filesystem::path(path).stem().string();
}

void TracingArguments::add_to(CLI::App& command) {
  command.add_option("--accel", accelerator, "Acceleration structure: as listed below")
      ->type_name("NAME[:KEY=VALUE,...]")
      ->capture_default_str();
  command.add_option("-j,--threads", threads, "Number of threads; auto or 0: one for each core")
      ->type_name("N")
      ->capture_default_str();
}

Status TracingArguments::check() const {
  if (!parse_threads(threads)) {
    return usage_error("--threads takes a number up to " + std::to_string(max_threads) + " or auto, not '" + threads +
                       "'");
  }
  return check_accelerator(accelerator);
}

Status check_accelerator(const std::string& spec) {
  const std::string name = spec.substr(0, spec.find(':'));
  const std::vector<std::string_view> names = accelerator_names();
  if (std::find(names.begin(), names.end(), name) != names.end()) return success();
  std::string there_are;
  for (std::string_view n : names) there_are += (there_are.empty() ? "" : ", ") + std::string(n);
  return usage_error("there is no acceleration structure '" + name + "'; there are: " + there_are);
}

std::string accelerator_help() {
  std::string text = "Acceleration structures (--accel):";
  for (std::string_view name : accelerator_names()) {
    text += "\n  " + std::string(name) + std::string(name.size() < 22 ? 22 - name.size() : 1, ' ') +
            std::string(accelerator_doc(name));
  }
  return text;
}

int TracingArguments::thread_count() const {
  return parse_threads(threads).value_or(1);
}

Result<Model> load(const SceneArguments& arguments, Console& console) {
  const Result<LoadOptions> options = load_options(arguments);
  if (!options) return options.error();
  Result<std::vector<SectionCut>> cuts = parse_cuts(arguments.section);
  if (!cuts) return cuts.error();
  console.progress().begin("reading " + arguments.path);
  Result<Model> model = load_model(arguments.path, *options, console.diagnostics());
  console.progress().end();
  if (!model) return model;
  model->section.insert(model->section.end(), cuts->begin(), cuts->end());
  SceneGraph& graph = model->graph;
  if (arguments.cut_faces == "base" && graph.root) {
    graph.root = graph.add({CutFacesAttribute{CutFaces::base}, {graph.root}});
  }
  return model;
}

namespace {

// The pictures that environment lights are made of.
Status read_environments(std::vector<Light>& lights, Console& console) {
  for (Light& light : lights) {
    if (light.file.empty()) continue;
    console.progress().begin("reading " + light.file);
    Result<LightPicture> picture = read_light(light.file);
    if (!picture) {
      return Error{picture.error().kind, "'" + light.file + "': " + picture.error().message, light.file_named_at};
    }
    light.map = std::make_shared<const LightMap>(LightMap{picture->width, picture->height, std::move(picture->rgb)});
  }
  return success();
}

Result<Model> load_with_pictures(const SceneArguments& arguments, Console& console) {
  Result<Model> model = load(arguments, console);
  if (!model) return model;
  if (Status status = read_environments(model->lights, console); !status) return status.error();
  return model;
}

}  // namespace

Result<std::string> scene_fingerprint(const SceneArguments& arguments, Console& console) {
  const Result<Model> model = load_with_pictures(arguments, console);
  if (!model) return model.error();
  return model_fingerprint(*model);
}

Result<TraceableScene> prepare(const SceneArguments& arguments, const TracingArguments& tracing, Console& console,
                               const PictureRequest* picture) {
  if (Status status = tracing.check(); !status) return status.error();
  Result<Model> model = load_with_pictures(arguments, console);
  if (!model) return model.error();
  console.progress().begin("compiling " + arguments.path);
  const std::string fingerprint = picture != nullptr ? model_fingerprint(*model) : "";
  Result<Scene> scene =
      compile_scene(std::move(*model), console.diagnostics(), picture != nullptr ? picture->view : ViewRequest{});
  if (!scene) return scene.error();
  std::optional<ScreenView> screen;
  if (picture != nullptr) {
    const Result<CameraRays> rays = CameraRays::create(scene->camera, picture->width, picture->height);
    if (!rays) return rays.error();
    // Through a lens primary rays do not start at the eye.
    if (!rays->has_lens()) screen = rays->view();
  }

  Result<BuiltAccelerator> built = build_timed(tracing.accelerator, *scene, screen ? &*screen : nullptr, console);
  if (!built) return built.error();
  if (scene->whole) {
    Result<std::unique_ptr<Accelerator>> whole = build_accelerator(tracing.accelerator, *scene->whole);
    if (!whole) return whole.error();
    built->accelerator =
        light_of_the_whole(std::move(built->accelerator), std::move(*whole), scene->first_section_plane);
  }
  return TraceableScene{std::move(*scene), std::move(built->accelerator), built->seconds, fingerprint};
}

Result<BuiltAccelerator> build_timed(const std::string& spec, const Scene& scene, const ScreenView* view,
                                     Console& console) {
  console.progress().begin("building " + spec);
  const auto begun = std::chrono::steady_clock::now();
  Result<std::unique_ptr<Accelerator>> accelerator = build_accelerator(spec, *scene.tree, view);
  if (!accelerator) return accelerator.error();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  console.progress().end();
  return BuiltAccelerator{std::move(*accelerator), seconds};
}

}  // namespace tenon
