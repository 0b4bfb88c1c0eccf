#include <cstdio>
#include <memory>
#include <optional>

#include "commands.h"
#include "render_arguments.h"
#include "scene_arguments.h"
#include "statistics_json.h"
#include "tenon/base/atomic_file.h"
#include "tenon/image/picture_file.h"
#include "tenon/render/renderer.h"
#include "tenon/version.h"

namespace tenon {

namespace {

struct RenderCommand {
  SceneArguments scene;
  TracingArguments tracing;
  RenderArguments render;

  Status run() const;
};

// A file to be written when all is done, or standard output.
class Output {
 public:
  static Result<Output> open(const std::string& path) {
    Output output;
    if (path == "-") return output;
    Result<AtomicFile> file = AtomicFile::create(path);
    if (!file) return file.error();
    output.file_.emplace(std::move(*file));
    return output;
  }
  Status finish(std::string_view bytes) {
    if (!file_) return write_standard_output(bytes);
    if (Status status = file_->write(bytes); !status) return status;
    return file_->commit();
  }

 private:
  std::optional<AtomicFile> file_;
};

// What the picture depends on, and nothing else: the same picture is the same file, whatever threads, structure and
// name it was made with.
std::vector<PictureNote> picture_notes(const RenderCommand& command, const RenderPlan& plan) {
  std::string line = "tenon render " + command.scene.path;
  for (const std::string& definition : command.scene.definitions) line += " -D '" + definition + '\'';
  line += " --facets " + command.scene.facets + " --size " + command.render.size + " --integrator " +
          command.render.integrator + " --spp " + std::to_string(command.render.samples) + " --depth " +
          std::to_string(plan.depth);
  if (plan.integrator == IntegratorKind::path) line += " --seed " + std::to_string(command.render.seed);
  for (const std::string& cut : command.scene.section.cuts) line += " --cut " + cut;
  line += command.render.view.words();
  return {{"Software", "tenon " + std::string(version())}, {"Title", command.scene.path}, {"Source", line}};
}

Result<std::string> encode(const Film& film, const RenderPlan& plan, const std::vector<PictureNote>& notes) {
  const PictureView picture{film.width(), film.height(), film.rgb()};
  return plan.format == PictureFormat::png ? encode_png(picture, plan.bits, notes)
                                           : encode_exr(picture, plan.bits, notes);
}

void say_done(Console& console, const RenderPlan& plan, const Rendering& rendering) {
  const auto rays = static_cast<double>(rendering.statistics.total().rays);
  char text[128];
  std::snprintf(text, sizeof text, ": %dx%d, %.3g million rays in %.2f s", plan.width, plan.height, rays / 1e6,
                rendering.seconds);
  console.progress().say("tenon: " + (plan.output == "-" ? "standard output" : plan.output) + text);
}

Status RenderCommand::run() const {
  const Result<RenderPlan> plan = plan_render(render, scene.stem());
  if (!plan) return plan.error();
  Console console(scene.quiet);
  const PictureRequest picture{plan->view, plan->width, plan->height};
  const Result<TraceableScene> traceable = prepare(scene, tracing, console, &picture);
  if (!traceable) return traceable.error();

  // Both files are begun now: better to learn that a place cannot be written before an hour of rendering than after.
  Result<Output> picture_file = Output::open(plan->output);
  if (!picture_file) return picture_file.error();
  std::optional<Output> statistics_file;
  if (!render.statistics.empty()) {
    Result<Output> file = Output::open(render.statistics);
    if (!file) return file.error();
    statistics_file.emplace(std::move(*file));
  }

  RenderOptions options;
  options.width = plan->width;
  options.height = plan->height;
  options.samples = render.samples;
  options.integrator = plan->integrator;
  options.depth = plan->depth;
  options.seed = render.seed;
  options.threshold = invisible_share(plan->bits == 8 ? 8 : 16);
  options.threads = tracing.thread_count();
  console.progress().begin("rendering");
  const Result<Rendering> rendering =
      tenon::render(traceable->scene, *traceable->accelerator, options, &console.progress().counters());
  if (!rendering) return rendering.error();

  console.progress().begin("writing " + plan->output);
  const Result<std::string> bytes = encode(rendering->film, *plan, picture_notes(*this, *plan));
  if (!bytes) return bytes.error();
  if (Status status = picture_file->finish(*bytes); !status) return status;
  if (statistics_file) {
    const std::string json = statistics_json(tracing.accelerator, *traceable, *rendering);
    if (Status status = statistics_file->finish(json); !status) return status;
  }
  console.progress().end();
  if (!scene.quiet) say_done(console, *plan, *rendering);
  return success();
}

}  // namespace

CommandBody add_render_command(CLI::App& command) {
  const auto arguments = std::make_shared<RenderCommand>();
  arguments->scene.add_to(command);
  arguments->render.add_to(command);
  arguments->tracing.add_to(command);
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
