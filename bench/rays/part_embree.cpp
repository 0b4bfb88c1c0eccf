#include <algorithm>
#include <map>

#include "rays/answers.h"
#include "rays/embree_tracer.h"
#include "rays/mesh.h"
#include "rays/parts.h"
#include "rays/tenon_tracer.h"

namespace tenon::bench {

namespace {

// Ratios by what is compared, over the scenes.
using Ratios = std::map<std::string, std::vector<double>>;

class EmbreeDuel {
 public:
  EmbreeDuel(const PartOptions& options, Report& report) : options_(options), report_(report) {}

  Status fight(const std::string& name) {
    Result<BenchScene> scene = read_scene(scene_path(name));
    if (!scene) return scene.error();
    const ScreenView& view = scene->camera.view();
    Result<std::unique_ptr<Accelerator>> accelerator =
        build_accelerator(options_.accelerator, *scene->scene.tree, &view);
    if (!accelerator) return accelerator.error();
    // Rays start above where either mesh may lie.
    const double lift = 2 * largest_error(*scene, picture_width);
    const std::vector<RaySet> sets = make_ray_sets(*scene, **accelerator, lift);

    std::vector<std::unique_ptr<Tracer>> tracers;
    // The first is held against Embree's packets, the second against its single rays.
    tracers.push_back(std::make_unique<TenonTracer>("tenon " + options_.accelerator, **accelerator));
    tracers.push_back(
        std::make_unique<TenonTracer>("tenon " + options_.accelerator + ", ray by ray", **accelerator, 1));
    std::vector<std::unique_ptr<EmbreeScene>> trees;
    for (const int columns : {picture_width, 1920}) {
      const Result<MadeMesh> made = make_mesh(*scene, columns, results_folder());
      if (!made) return made.error();
      trees.push_back(std::make_unique<EmbreeScene>(made->mesh));
      const std::string mesh = "mesh " + std::to_string(columns);
      report_.figure(name, mesh + ": triangles", static_cast<double>(made->mesh.size()), "");
      report_.figure(name, mesh + ": making it", made->cpu_seconds, "CPU s");
      report_.figure(name, mesh + ": building Embree's tree", trees.back()->build_seconds(), "CPU s");
      for (const int width : {1, 8, 16}) {
        tracers.push_back(make_embree_tracer("embree " + std::to_string(width) + " " + mesh, *trees.back(), width));
      }
    }
    if (const std::vector<Ball> balls = bare_balls(scene->scene); !balls.empty()) {
      trees.push_back(std::make_unique<EmbreeScene>(balls));
      for (const int width : {1, 8, 16}) {
        tracers.push_back(make_embree_tracer("embree " + std::to_string(width) + " bare balls", *trees.back(), width));
      }
    }
    for (const RaySet& set : sets) {
      if (!options_.traces(set.name())) continue;
      if (Status status = trace(name, set, tracers); !status) return status;
    }
    return success();
  }

  void summarize() {
    for (const auto& [what, ratios] : ratios_) report_.summary("tenon " + what, ratios);
  }

 private:
  Status trace(const std::string& scene, const RaySet& set, const std::vector<std::unique_ptr<Tracer>>& tracers) {
    for (const int threads : {1, options_.threads}) {
      const std::vector<Timing> timings = time_tracers(tracers, set, threads);
      const std::string label = std::string(set.name()) + (threads == 1 ? "" : " x" + std::to_string(threads));
      for (const Timing& t : timings) {
        report_.rate(scene, label, t, set.rays.size(), nullptr);
        if (!t.name.starts_with("embree")) continue;
        const bool is_single = t.name.starts_with("embree 1 ");
        ratios_[(is_single ? "ray by ray against " : "against ") + t.name + ", " + label].push_back(
            ratio(t, timings[is_single ? 1 : 0]));
      }
      if (options_.threads == 1) break;
    }
    const std::vector<Answer> own = tracers.front()->answers();
    for (const auto& tracer : tracers) {
      const std::vector<Answer> answers = tracer->answers();
      const bool same_solid = tracer->name().find("bare") == std::string::npos;
      if (tracer->name().starts_with("embree") && same_solid) {
        report_.figure(scene, std::string(set.name()) + " rays of " + tracer->name() + " that disagree",
                       100.0 * static_cast<double>(count_disagreements(own, answers, set.kind)) /
                           static_cast<double>(answers.size()),
                       "%");
      }
      if (set.kind == RayKind::primary) {
        std::string file = scene + "_" + tracer->name() + ".png";
        std::replace(file.begin(), file.end(), ' ', '_');
        std::replace(file.begin(), file.end(), ':', '_');
        if (Status status = save_answers(set, *tracer, results_folder() + "/" + file); !status) return status;
      }
      tracer->unload();
    }
    return success();
  }

  const PartOptions& options_;
  Report& report_;
  Ratios ratios_;
};

}  // namespace

Status run_embree(const PartOptions& options, Report& report) {
  report.note(
      "Embree: RTC_BUILD_QUALITY_HIGH, RTC_SCENE_FLAG_ROBUST, single precision; the same stored rays on both sides");
  EmbreeDuel duel(options, report);
  for (const std::string& name : options.scenes) {
    report.heading(name);
    if (Status status = duel.fight(name); !status) return status;
  }
  report.heading("how many times as fast as the other");
  duel.summarize();
  return success();
}

}  // namespace tenon::bench
