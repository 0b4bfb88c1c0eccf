#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>

#include "rays/embree_tracer.h"
#include "rays/mesh.h"
#include "rays/parts.h"
#include "rays/sampled_race.h"
#include "rays/tenon_tracer.h"

namespace tenon::bench {

namespace {

double seconds_since(std::chrono::steady_clock::time_point begun) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
}

struct BuiltStructure {
  std::unique_ptr<Accelerator> accelerator;
  double seconds = 0;
};

Result<BuiltStructure> build(const std::string& spec, const BenchScene& scene) {
  const auto begun = std::chrono::steady_clock::now();
  const ScreenView& view = scene.camera.view();
  Result<std::unique_ptr<Accelerator>> built = build_accelerator(spec, *scene.scene.tree, &view);
  if (!built) return built.error();
  return BuiltStructure{std::move(*built), seconds_since(begun)};
}

// OpenSCAD's examples, where they are installed; those that Tenon cannot draw yet are passed over.
std::vector<std::string> example_paths() {
  std::vector<std::string> paths;
  const std::filesystem::path folder = "/usr/share/openscad/examples";
  if (!std::filesystem::exists(folder)) return paths;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".scad" && read_scene(entry.path().string()))
      paths.push_back(entry.path().string());
  }
  std::sort(paths.begin(), paths.end());
  return paths;
}

Status compare_structures(const std::string& path, const PartOptions& options, Report& report,
                          std::map<std::string, std::vector<double>>& against_best) {
  const Result<BenchScene> scene = read_scene(path);
  if (!scene) return scene.error();
  std::vector<BuiltStructure> structures;
  std::vector<std::unique_ptr<Tracer>> tracers;
  const std::string own_name = options.accelerator.substr(0, options.accelerator.find(':'));
  const auto add = [&](const std::string& spec) -> Status {
    Result<BuiltStructure> built = build(spec, *scene);
    if (!built && built.error().kind == ErrorKind::usage) return built.error();
    if (!built) {
      report.note(spec + " is left out: " + built.error().message);
      return success();
    }
    report.figure(scene->name, spec + ": building it", built->seconds, "s");
    tracers.push_back(std::make_unique<TenonTracer>(spec, *built->accelerator));
    if (structures.empty()) {
      tracers.push_back(std::make_unique<TenonTracer>(spec + ", ray by ray", *built->accelerator, 1));
    }
    structures.push_back(std::move(*built));
    return success();
  };
  if (Status status = add(options.accelerator); !status) return status;
  for (const std::string_view name : accelerator_names()) {
    if (name == "none" || name == own_name) continue;
    const auto& against = options.against;
    if (!against.empty() && std::find(against.begin(), against.end(), name) == against.end()) continue;
    if (Status status = add(std::string(name)); !status) return status;
  }
  for (const RaySet& set : make_ray_sets(*scene, *structures.front().accelerator, small_lift(*scene))) {
    if (set.rays.empty() || !options.traces(set.name())) continue;
    const auto& [timings, disagreements] = race_on_samples(tracers, set);
    double least = Box3::inf;
    for (const Timing& t : timings) {
      report.rate(scene->name, std::string(set.name()), t, set.rays.size(), &timings.front());
      const bool is_own = t.name.starts_with(options.accelerator);
      if (!is_own) least = std::min(least, ratio(t, timings.front()));
    }
    if (least < Box3::inf) against_best[std::string(set.name())].push_back(least);
    for (std::size_t i = 0; i < tracers.size(); ++i) {
      const std::size_t differ = disagreements[i];
      if (differ > 0) report.note(tracers[i]->name() + " DISAGREES on " + std::to_string(differ) + " rays");
    }
  }
  return success();
}

// A set eight times over, so that it makes little difference how long threads take to start: one pass lasts a few
// milliseconds. Tracers may change the rays they have loaded, so none traces one twice.
RaySet eightfold(RaySet set) {
  const std::size_t count = set.rays.size();
  set.rays.resize(8 * count);
  for (std::size_t i = count; i < set.rays.size(); ++i) set.rays[i] = set.rays[i - count];
  return set;
}

std::string sphere_label(int spheres) {
  return std::to_string(spheres) + " spheres";
}

// A box minus some spheres, and its rays.
struct GrowthScene {
  GrowthScene(int n, BenchScene&& read, BuiltStructure&& structure)
      : spheres(n), scene(std::move(read)), built(std::move(structure)), balls(bare_balls(scene.scene)) {}
  std::string label() const { return sphere_label(spheres); }

  int spheres;
  BenchScene scene;
  BuiltStructure built;
  EmbreeScene balls;
  std::vector<std::unique_ptr<Tracer>> tracers;
  std::vector<RaySet> sets;
};

Result<std::unique_ptr<GrowthScene>> make_growth_scene(int spheres, const PartOptions& options, Report& report) {
  const std::string label = sphere_label(spheres);
  report.heading(label);
  const auto begun = std::chrono::steady_clock::now();
  Result<BenchScene> read = read_scene(scene_path("spheres"), {{"n", std::to_string(spheres)}});
  if (!read) return read.error();
  report.figure(label, "reading and compiling", seconds_since(begun), "s");
  Result<BuiltStructure> built = build(options.accelerator, *read);
  if (!built) return built.error();
  report.figure(label, "building " + options.accelerator, built->seconds, "s");
  report.figure(label, "memory of it", static_cast<double>(built->accelerator->figures().memory_bytes) / 0x1p20, "MiB");
  auto scene = std::make_unique<GrowthScene>(spheres, std::move(*read), std::move(*built));
  const Accelerator& accelerator = *scene->built.accelerator;
  scene->tracers.push_back(std::make_unique<TenonTracer>(options.accelerator, accelerator));
  scene->tracers.push_back(make_embree_tracer("embree 16 bare balls", scene->balls, 16));
  scene->sets = make_ray_sets(scene->scene, accelerator, small_lift(scene->scene));
  return scene;
}

}  // namespace

Status run_structures(const PartOptions& options, Report& report) {
  struct Group {
    std::string name;
    std::vector<std::string> paths;
  };
  std::vector<Group> groups;
  const auto add = [&](const std::string& name, const std::vector<std::string>& scenes) {
    Group& group = groups.emplace_back(Group{name, {}});
    for (const std::string& scene : scenes) group.paths.push_back(scene_path(scene));
  };
  if (!options.files.empty()) {
    groups.push_back({"scenes of files", options.files});
  } else {
    add("the six scenes", options.scenes);
    if (options.scenes == scene_names()) add("media, copies and a model", own_scenes);
    if (options.against.empty()) groups.push_back({"OpenSCAD's examples", example_paths()});
  }
  std::vector<std::map<std::string, std::vector<double>>> ratios(groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const std::string& path : groups[i].paths) {
      report.heading(path);
      if (Status status = compare_structures(path, options, report, ratios[i]); !status) return status;
    }
  }
  report.heading("how many times as fast as the best of the others on each scene");
  for (std::size_t i = 0; i < groups.size(); ++i) {
    for (const auto& [rays, of_scenes] : ratios[i]) report.summary(rays + " rays, " + groups[i].name, of_scenes);
  }
  return success();
}

// What Embree does with the bare spheres shows what growth costs a structure that knows of no Booleans. Scenes of all
// sizes take turns: what slows the machine down for a while would else be taken for growth.
Status run_growth(const PartOptions& options, Report& report) {
  std::vector<std::unique_ptr<GrowthScene>> scenes;
  for (int n = 100; n <= options.largest_growth; n *= 10) {
    Result<std::unique_ptr<GrowthScene>> scene = make_growth_scene(n, options, report);
    if (!scene) return scene.error();
    scenes.push_back(std::move(*scene));
  }
  report.heading("all of them in turns");
  std::map<std::string, std::map<int, Timing>> by_contender;  // of a ray, by number of spheres
  for (std::size_t kind = 0; kind < ray_sets_of_a_scene; ++kind) {
    std::vector<std::string> names;
    std::vector<std::pair<const GrowthScene*, Tracer*>> contenders;
    for (const auto& scene : scenes) {
      for (const auto& tracer : scene->tracers) {
        contenders.emplace_back(scene.get(), tracer.get());
        names.push_back(tracer->name());
      }
    }
    std::vector<Timing> timings = take_turns(names, rounds, [&](std::size_t i) {
      const auto& [scene, tracer] = contenders[i];
      const double seconds = trace_once(*tracer, scene->sets[kind], 1);
      tracer->unload();
      return seconds;
    });
    for (std::size_t i = 0; i < contenders.size(); ++i) {
      const GrowthScene& scene = *contenders[i].first;
      const RaySet& set = scene.sets[kind];
      report.rate(scene.label(), std::string(set.name()), timings[i], set.rays.size());
      for (double& seconds : timings[i].seconds) seconds /= static_cast<double>(set.rays.size());
      by_contender[names[i] + ", " + std::string(set.name()) + " rays"].emplace(scene.spheres, std::move(timings[i]));
    }
  }
  report.heading("how many times slower than with 1000 spheres");
  for (const auto& [rays, by_n] : by_contender) {
    for (const auto& [n, timing] : by_n) {
      if (n > 1000) report.figure(sphere_label(n), rays, ratio(timing, by_n.at(1000)), "times");
    }
  }
  return success();
}

Status run_cores(const PartOptions& options, Report& report) {
  std::map<std::string, std::vector<double>> ratios;
  for (const std::string& name : options.scenes) {
    const Result<BenchScene> scene = read_scene(scene_path(name));
    if (!scene) return scene.error();
    Result<BuiltStructure> built = build(options.accelerator, *scene);
    if (!built) return built.error();
    std::vector<std::unique_ptr<Tracer>> tracers;
    tracers.push_back(std::make_unique<TenonTracer>(options.accelerator, *built->accelerator));
    for (const RaySet& once : make_ray_sets(*scene, *built->accelerator, small_lift(*scene))) {
      const RaySet set = eightfold(once);
      const Timing one = time_tracers(tracers, set, 1).front();
      const Timing all = time_tracers(tracers, set, options.threads).front();
      report.rate(name, std::string(set.name()), one, set.rays.size());
      report.rate(name, std::string(set.name()) + " x" + std::to_string(options.threads), all, set.rays.size());
      ratios[std::string(set.name())].push_back(one.median() / all.median());
    }
  }
  for (const auto& [rays, r] : ratios) {
    report.summary(std::to_string(options.threads) + " cores against one, " + rays + " rays", r);
  }
  return success();
}

Status run_start(const PartOptions& options, Report& report) {
  std::map<int, std::vector<double>> ratios;
  for (const std::string& name : options.scenes) {
    std::vector<double> own;
    for (int i = 0; i < rounds; ++i) {
      Status failed = success();
      own.push_back(cpu_seconds([&] {
        const Result<BenchScene> scene = read_scene(scene_path(name));
        if (!scene) return void(failed = scene.error());
        const Result<BuiltStructure> built = build(options.accelerator, *scene);
        if (!built) return void(failed = built.error());
        RayQuery query;
        query.ray = scene->camera.ray(0.5 * picture_width, 0.5 * picture_height);
        (void)built->accelerator->first_hit(query, *built->accelerator->make_context());
      }));
      if (!failed) return failed;
    }
    report.figure(name, "from text to the first ray", median(own), "CPU s");
    const Result<BenchScene> scene = read_scene(scene_path(name));
    for (const int columns : {picture_width, 1920}) {
      const Result<MadeMesh> made = make_mesh(*scene, columns, results_folder());
      if (!made) return made.error();
      const double theirs = made->cpu_seconds + EmbreeScene(made->mesh).build_seconds();
      report.figure(name, "mesh " + std::to_string(columns) + " and Embree's tree", theirs, "CPU s");
      ratios[columns].push_back(theirs / median(own));
    }
  }
  for (const auto& [columns, r] : ratios) {
    report.summary("sooner than the mesh for " + std::to_string(columns) + " columns and its tree", r);
  }
  return success();
}

}  // namespace tenon::bench
