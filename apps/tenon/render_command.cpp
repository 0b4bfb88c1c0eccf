#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "animation.h"
#include "checkpoint.h"
#include "commands.h"
#include "heat_map_arguments.h"
#include "numbers.h"
#include "picture_arguments.h"
#include "picture_notes.h"
#include "picture_output.h"
#include "render_arguments.h"
#include "scene_arguments.h"
#include "statistics_json.h"
#include "tenon/base/interrupt.h"
#include "tenon/film/denoise.h"
#include "tenon/render/renderer.h"
#include "work_arguments.h"

namespace tenon {

namespace {

struct RenderCommand {
  SceneArguments scene;
  TracingArguments tracing;
  RenderArguments render;
  WorkArguments work;
  PictureArguments picture;
  HeatMapArguments heat_map;

  Status run() const;

 private:
  Status check_heat_map() const;
  Status take_heat_map(const RenderPlan& plan, const PicturePlan& file, const RenderOptions& options,
                       Console& console) const;
  Status animate(const RenderPlan& plan, const PicturePlan& file, const RenderOptions& options, Console& console) const;
  Result<std::string> problem_of_frame(const std::string& path, const RenderOptions& options, Console& console) const;
  Status take(const RenderPlan& plan, const PicturePlan& file, const RenderOptions& options, const std::string& what,
              Console& console) const;
  /// The files of a picture, begun.
  struct Outputs {
    Output picture;
    std::optional<Output> statistics;
  };
  Result<Outputs> open_outputs(const PicturePlan& file) const;
  Result<RenderOptions> plan_options(const RenderPlan& plan, const PicturePlan& file) const;
  void warn_of_idle_arguments(const Scene& shown, Diagnostics& diagnostics) const;
  std::string dependent_arguments(const RenderOptions& options) const;
  void say_end(Console& console, const PicturePlan& file, const FilmPart& part, const Rendering& rendering) const;
};

// Less than the usual depth somebody chose, and knows why.
void warn_of_depth(const DepthCut& cut, int depth, Diagnostics& diagnostics) {
  if (!cut.may_be_seen()) return;
  char text[240];
  std::snprintf(text, sizeof text,
                "paths of more than %d surfaces would bring about %.2g %% of the light, and %.2g %% around pixel "
                "%d,%d; take a larger "
                "--depth",
                depth, 100 * cut.share, 100 * cut.largest_share, (cut.tile.x0 + cut.tile.x1) / 2,
                (cut.tile.y0 + cut.tile.y1) / 2);
  diagnostics.warn(text);
}

// The arguments that the picture depends on. What it is taken with, in which parts, and where it goes are not among
// them.
std::string RenderCommand::dependent_arguments(const RenderOptions& options) const {
  std::string text;
  for (const std::string& definition : scene.definitions) text += " -D '" + definition + '\'';
  text += " --facets " + scene.facets + " --size " + render.size + " --integrator " + render.integrator + " --spp " +
          std::to_string(options.samples) + " --depth " + std::to_string(options.depth);
  if (options.integrator == IntegratorKind::path) text += " --seed " + std::to_string(options.seed);
  for (const std::string& cut : scene.section.cuts) text += " --cut " + cut;
  if (scene.cut_faces != "tool") text += " --cut-faces " + scene.cut_faces;
  text += render.view.words() + render.section_style.words();
  if (options.transparent) text += " --transparent";
  if (options.noise > 0) text += " --noise " + shortest(options.noise);
  return text;
}

Result<RenderOptions> RenderCommand::plan_options(const RenderPlan& plan, const PicturePlan& file) const {
  RenderOptions options;
  options.width = plan.width;
  options.height = plan.height;
  options.integrator = plan.integrator;
  options.depth = plan.depth;
  options.seed = render.seed;
  options.hatch = plan.hatch;
  // Whatever file the picture ends in: parts of it are kept as EXR, and are to add up to the same.
  options.threshold = invisible_share(16);
  options.threads = tracing.thread_count();
  options.transparent = render.transparent;
  options.layers = file.denoise ? file.layers | denoise_layers() : file.layers;
  if (Status status = plan_work(work, options); !status) return status.error();
  if (file.denoise && options.end_sample.value_or(options.samples) - options.first_sample < 2) {
    return usage_error(
        "--denoise tells noise by what a pixel's samples differ in; take two of them at least, with --spp (and "
        "--samples)");
  }
  if (Status status = check_memory(Film::bytes(film_window(options), film_layers(options)), render.size); !status) {
    return status.error();
  }
  return options;
}

void RenderCommand::say_end(Console& console, const PicturePlan& file, const FilmPart& part,
                            const Rendering& rendering) const {
  const PixelWindow& window = part.film.window();
  const auto rays = static_cast<double>(rendering.statistics.total().rays);
  char text[128];
  std::snprintf(text, sizeof text, ": %dx%d, %.3g million rays in %.2f s", window.width(), window.height(), rays / 1e6,
                rendering.seconds);
  std::string line = "tenon: " + (file.output == "-" ? "standard output" : file.output) + text;
  if (rendering.end != RenderEnd::finished) {
    std::snprintf(text, sizeof text, "; %s, with %.1f samples a pixel",
                  rendering.end == RenderEnd::interrupted ? "interrupted" : "time is over", part.film.mean_samples());
    line += text;
  }
  console.progress().say(line);
}

Status RenderCommand::run() const {
  const std::string stem = scene.stem();
  const Result<PicturePlan> file = plan_picture(picture, stem.empty() ? "" : stem + ".png");
  if (!file) return file.error();
  if (file->output == "-" && render.statistics == "-") {
    return usage_error("the picture and the statistics cannot both go to standard output");
  }
  const Result<RenderPlan> plan = plan_render(render);
  if (!plan) return plan.error();
  const Result<RenderOptions> options = plan_options(*plan, *file);
  if (!options) return options.error();
  Console console(scene.quiet);
  if (heat_map.wanted()) {
    if (Status status = check_heat_map(); !status) return status;
    return take_heat_map(*plan, *file, *options, console);
  }
  return work.frames == 0 ? take(*plan, *file, *options, "rendering", console)
                          : animate(*plan, *file, *options, console);
}

Status RenderCommand::animate(const RenderPlan& plan, const PicturePlan& file, const RenderOptions& options,
                              Console& console) const {
  if (file.output == "-" || scene.path == "-" || !render.statistics.empty()) {
    return usage_error("--animate goes with files for the scene and the pictures, and without --stats");
  }
  RenderCommand frame = *this;
  int were_there = 0;
  for (int i = 0; i < work.frames && noted_interrupt() == 0; ++i) {
    PicturePlan frame_file = file;
    frame_file.output = frame_path(file.output, i);
    frame.scene.definitions = scene.definitions;
    frame.scene.definitions.push_back(frame_definition(i, work.frames));
    if (work.resume && std::filesystem::exists(frame_file.output)) {
      const Result<std::string> problem = frame.problem_of_frame(frame_file.output, options, console);
      if (!problem) return problem.error();
      if (problem->empty()) {
        ++were_there;
        continue;
      }
      console.diagnostics().warn(*problem + "; it is taken again");
    }
    const std::string what = "rendering frame " + std::to_string(i + 1) + " of " + std::to_string(work.frames);
    if (Status status = frame.take(plan, frame_file, options, what, console); !status) return status;
  }
  if (work.resume && !scene.quiet) {
    console.progress().say("tenon: " + std::to_string(were_there) + " of " + std::to_string(work.frames) +
                           " frames were there");
  }
  return success();
}

// Why a frame's file is not the one that would be taken, as far as it says; empty where it is.
Result<std::string> RenderCommand::problem_of_frame(const std::string& path, const RenderOptions& options,
                                                    Console& console) const {
  const Result<Picture> head = read_head(path);
  if (!head) return head.error().message;
  const PixelWindow window = options.crop.value_or(PixelWindow{0, 0, options.width, options.height});
  bool is_same = head->window.width() == window.width() && head->window.height() == window.height();
  const Result<std::string> fingerprint = scene_fingerprint(scene, console);
  if (!fingerprint) return fingerprint.error();
  const PictureOrigin origin{scene.path, dependent_arguments(options), *fingerprint, options.seed, {}};
  for (const PictureNote& note : picture_notes(origin)) {
    // The camera follows from the rest, but takes long to be chosen.
    const std::string* found = head->note(note.key);
    is_same = is_same && (note.key == "Camera" || (found != nullptr && *found == note.text));
  }
  return is_same ? "" : "'" + path + "' is of another scene or other arguments";
}

// What a picture of costs has no use for.
Status RenderCommand::check_heat_map() const {
  const std::pair<const char*, bool> others[]{{"--denoise", picture.denoise},
                                              {"--hatch", render.section_style.hatch},
                                              {"--layers", !picture.layers.empty()},
                                              {"--tonemap", picture.tone_curve != "none"},
                                              {"--exposure", picture.exposure != 0},
                                              {"--transparent", render.transparent},
                                              {"--noise", work.noise > 0},
                                              {"--time", work.seconds > 0},
                                              {"--checkpoint", !work.checkpoint.empty()},
                                              {"--animate", work.frames > 0}};
  for (const auto& [name, given] : others) {
    if (given) return usage_error(std::string("--heatmap shows numbers, not light; leave ") + name + " out");
  }
  return success();
}

Status RenderCommand::take_heat_map(const RenderPlan& plan, const PicturePlan& file, const RenderOptions& options,
                                    Console& console) const {
  const PictureRequest request{plan.view, plan.width, plan.height};
  const Result<TraceableScene> traceable = prepare(scene, tracing, console, &request);
  if (!traceable) return traceable.error();
  Result<Outputs> outputs = open_outputs(file);
  if (!outputs) return outputs.error();
  console.progress().begin("measuring");
  const Result<CostMap> map = measure_cost(traceable->scene, *traceable->accelerator, options, heat_map_takes(heat_map),
                                           &console.progress().counters());
  if (!map) return map.error();
  console.progress().begin("writing " + file.output);
  const std::vector<PictureNote> notes = picture_notes(
      {scene.path, dependent_arguments(options), traceable->fingerprint, options.seed, traceable->scene.camera});
  const Result<std::string> bytes = encode(*map, heat_map, file, tracing.accelerator, options, notes);
  if (!bytes) return bytes.error();
  if (Status status = outputs->picture.finish(*bytes); !status) return status;
  if (outputs->statistics) {
    const std::string json = statistics_json(tracing.accelerator, *traceable, map->threads, map->render_seconds,
                                             map->statistics, std::nullopt);
    if (Status status = outputs->statistics->finish(json); !status) return status;
  }
  console.progress().end();
  return success();
}

// Whether these have anything to do follows from the scene, so that they are no mistake on a command line for many.
void RenderCommand::warn_of_idle_arguments(const Scene& shown, Diagnostics& diagnostics) const {
  const bool is_cut = static_cast<bool>(shown.first_section_plane);
  const auto without_cut = [&](const std::string& name) {
    diagnostics.warn(name + " does nothing, since nothing is cut; add --cut, or section() to the scene");
  };
  if (render.section_style.hatch && !is_cut) without_cut("--hatch");
  if (render.section_style.light == "keep" && !is_cut) without_cut("--cut-light keep");
  if (!render.view.focus.empty() && shown.camera.aperture == 0) {
    diagnostics.warn("--focus does nothing, since all is sharp without a lens; add --aperture");
  }
}

// All files are begun before the work: better to learn that a place cannot be written now than after an hour.
Result<RenderCommand::Outputs> RenderCommand::open_outputs(const PicturePlan& file) const {
  Result<Output> picture_file = Output::open(file.output);
  if (!picture_file) return picture_file.error();
  Outputs outputs{std::move(*picture_file), std::nullopt};
  if (render.statistics.empty()) return outputs;
  Result<Output> statistics_file = Output::open(render.statistics);
  if (!statistics_file) return statistics_file.error();
  outputs.statistics.emplace(std::move(*statistics_file));
  return outputs;
}

Status RenderCommand::take(const RenderPlan& plan, const PicturePlan& file, const RenderOptions& options,
                           const std::string& what, Console& console) const {
  const PictureRequest request{plan.view, plan.width, plan.height};
  const Result<TraceableScene> traceable = prepare(scene, tracing, console, &request);
  if (!traceable) return traceable.error();

  warn_of_idle_arguments(traceable->scene, console.diagnostics());

  FilmPart part;
  part.layers = file.layers;
  part.transparent = render.transparent;
  part.bits = file.format == PictureFormat::exr ? file.bits : 32;
  part.samples = options.samples;
  part.notes = picture_notes(
      {scene.path, dependent_arguments(options), traceable->fingerprint, options.seed, traceable->scene.camera});

  Result<Outputs> outputs = open_outputs(file);
  if (!outputs) return outputs.error();
  std::optional<Checkpoint> checkpoint;
  std::optional<Film> resumed;
  if (!work.checkpoint.empty()) {
    checkpoint.emplace(work.checkpoint, part);
    if (Status status = checkpoint->check(); !status) return status;
    if (work.resume) {
      Result<std::optional<Film>> film = checkpoint->load(options);
      if (!film) return film.error();
      resumed = std::move(*film);
    } else if (std::filesystem::exists(work.checkpoint)) {
      return Error{ErrorKind::input,
                   "there is a checkpoint '" + work.checkpoint +
                       "' already, and work may be lost with it; go on from it with --resume, or remove it",
                   {}};
    }
  }

  const InterruptDeferral deferral;
  RenderControl control;
  control.progress = &console.progress().counters();
  control.interrupted = [] { return noted_interrupt() != 0; };
  control.resumed = resumed ? &*resumed : nullptr;
  if (checkpoint) {
    control.checkpoint_seconds = work.checkpoint_seconds;
    control.checkpoint = [&](const Film& film, const std::vector<SampleBox>& done) {
      checkpoint->save(film, done, console);
    };
  }
  console.progress().begin(what);
  Result<Rendering> rendering = tenon::render(traceable->scene, *traceable->accelerator, options, control);
  if (!rendering) return rendering.error();

  // A frame of fewer samples would be taken for done by --resume.
  if (work.frames > 0 && rendering->end == RenderEnd::interrupted) {
    if (checkpoint) checkpoint->save(rendering->film, rendering->done, console);
    return success();
  }
  console.progress().begin("writing " + file.output);
  const bool finished = rendering->end == RenderEnd::finished;
  if (checkpoint && !finished) checkpoint->save(rendering->film, rendering->done, console);
  part.film = std::move(rendering->film);
  part.done = std::move(rendering->done);
  if (options.crop) part = cropped(part, *options.crop);
  const Result<std::string> bytes = encode(part, file, options.threads, console);
  if (!bytes) return bytes.error();
  if (Status status = outputs->picture.finish(*bytes); !status) return status;
  if (checkpoint && finished) checkpoint->remove();
  if (outputs->statistics) {
    const std::string json = statistics_json(tracing.accelerator, *traceable, rendering->threads, rendering->seconds,
                                             rendering->statistics, rendering->cut);
    if (Status status = outputs->statistics->finish(json); !status) return status;
  }
  console.progress().end();
  if (options.depth >= usual_path_depth) warn_of_depth(rendering->cut, options.depth, console.diagnostics());
  if (!scene.quiet) say_end(console, file, part, *rendering);
  return success();
}

}  // namespace

CommandBody add_render_command(CLI::App& command) {
  const auto arguments = std::make_shared<RenderCommand>();
  arguments->scene.add_to(command);
  arguments->picture.add_to(command);
  arguments->picture.add_layers_to(command);
  arguments->picture.add_denoise_to(command);
  arguments->render.add_to(command);
  arguments->work.add_to(command);
  arguments->heat_map.add_to(command);
  arguments->tracing.add_to(command);
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
