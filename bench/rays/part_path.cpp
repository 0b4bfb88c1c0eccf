#include <algorithm>
#include <chrono>

#include "rays/parts.h"
#include "rays/tenon_tracer.h"
#include "tenon/render/renderer.h"

namespace tenon::bench {

namespace {

// As the thesis renders.
RenderOptions thesis_options(int threads) {
  RenderOptions options;
  options.width = picture_width;
  options.height = picture_height;
  options.integrator = IntegratorKind::path;
  options.samples = 8;
  options.depth = 20;
  options.threads = threads;
  return options;
}

struct PictureTime {
  double cpu_seconds = 0, wall_seconds = 0;
  double rays = 0;
};

PictureTime take_picture(const BenchScene& scene, const Accelerator& accelerator, int threads) {
  PictureTime time;
  const auto begun = std::chrono::steady_clock::now();
  time.cpu_seconds = cpu_seconds([&] {
    const Result<Rendering> picture = render(scene.scene, accelerator, thesis_options(threads));
    if (picture) time.rays = static_cast<double>(picture->statistics.total().rays);
  });
  time.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return time;
}

}  // namespace

Status run_path(const PartOptions& options, Report& report) {
  std::vector<double> shares, speedups;
  // The scenes of the thesis; the others are the bench's own.
  for (const std::string name : {"grooved_sphere", "checkered_cube", "small_shell", "large_shell"}) {
    report.heading(name);
    const Result<BenchScene> scene = read_scene(scene_path(name));
    if (!scene) return scene.error();
    Result<std::unique_ptr<Accelerator>> accelerator = build_accelerator(options.accelerator, *scene->scene.tree);
    if (!accelerator) return accelerator.error();
    const std::vector<RaySet> sets = make_ray_sets(*scene, **accelerator, small_lift(*scene));
    const RaySet& diffuse =
        *std::find_if(sets.begin(), sets.end(), [](const RaySet& set) { return set.kind == RayKind::diffuse; });
    std::vector<std::unique_ptr<Tracer>> bare;
    bare.push_back(std::make_unique<TenonTracer>(options.accelerator, **accelerator));
    take_picture(*scene, **accelerator, 1);
    std::vector<double> bare_rates, path_rates, share, speedup;
    for (int round = 0; round < rounds; ++round) {
      const double seconds = time_tracers(bare, diffuse, 1).front().median();
      bare_rates.push_back(static_cast<double>(diffuse.rays.size()) / seconds);
      const PictureTime one = take_picture(*scene, **accelerator, 1);
      const PictureTime all = take_picture(*scene, **accelerator, options.threads);
      path_rates.push_back(one.rays / one.cpu_seconds);
      share.push_back(path_rates.back() / bare_rates.back());
      speedup.push_back(one.wall_seconds / all.wall_seconds);
    }
    report.figure(name, "bare incoherent rays", median(bare_rates) / 1e6, "M/CPU s");
    report.figure(name, "rays of path tracing", median(path_rates) / 1e6, "M/CPU s");
    report.figure(name, "share of the bare rate", median(share), "");
    report.figure(name, std::to_string(options.threads) + " cores against one", median(speedup), "times");
    shares.push_back(median(share));
    speedups.push_back(median(speedup));
  }
  report.summary("path tracing's rate against bare incoherent rays", shares);
  report.summary(std::to_string(options.threads) + " cores against one", speedups);
  return success();
}

}  // namespace tenon::bench
