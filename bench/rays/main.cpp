#include <hwy/targets.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "rays/bench_scene.h"
#include "rays/parts.h"
#include "tenon/accel/accelerator.h"
#include "tenon/base/parallel_for.h"

namespace {

using namespace tenon;
using namespace tenon::bench;

struct Part {
  const char* name;
  Status (*run)(const PartOptions& options, Report& report);
};

constexpr std::array<Part, 8> parts{{{"structures", run_structures},
                                     {"embree", run_embree},
                                     {"povray", run_povray},
                                     {"start", run_start},
                                     {"cores", run_cores},
                                     {"growth", run_growth},
                                     {"path", run_path},
                                     {"bunny", run_bunny}}};

int run(const Part& part, const PartOptions& options) {
  Report report(part.name);
  Status status = part.run(options, report);
  if (status) status = report.save();
  if (status) return 0;
  std::fprintf(stderr, "%s\n", format_error(status.error()).c_str());
  return static_cast<int>(status.error().kind);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Tenon's bench, from the repository's root. Results and pictures go to build/bench/results.");
  PartOptions options;
  options.accelerator = std::string(default_accelerator);
  options.threads = available_threads();
  std::vector<std::string> wanted, names;
  for (const Part& part : parts) names.emplace_back(part.name);
  app.add_option("PART", wanted, "What to run; all of it when nothing is named")->check(CLI::IsMember(names));
  app.add_option("--accel", options.accelerator, "Tenon's contender")->capture_default_str();
  app.add_option("-j,--threads", options.threads, "What all cores are")
      ->capture_default_str()
      ->check(CLI::Range(1, 4096));
  app.add_option("--largest", options.largest_growth, "Spheres of the largest scene of `growth`")
      ->capture_default_str();
  app.add_option("--scene", options.scenes, "Of the six scenes only these")->check(CLI::IsMember(scene_names()));
  app.add_option("--file", options.files, "`structures`: on these scene files instead")->check(CLI::ExistingFile);
  app.add_option("--rays", options.rays, "Of the kinds of ray only these")
      ->delimiter(',')
      ->check(CLI::IsMember({"primary", "shadow", "diffuse"}));
  app.add_option("--against", options.against, "`structures`: of the structures only these, on the six scenes")
      ->delimiter(',')
      ->check(CLI::IsMember(accelerator_names()));
  const std::map<std::string, std::int64_t> wider_than{{"avx512", 0}, {"avx2", HWY_AVX2 - 1}, {"sse4", HWY_SSE4 - 1}};
  std::int64_t disabled = 0;
  app.add_option("--instructions", disabled, "The widest that Tenon may use: avx512, avx2 or sse4")
      ->transform(CLI::CheckedTransformer(wider_than));
  CLI11_PARSE(app, argc, argv);
  hwy::DisableTargets(disabled);
  if (options.scenes.empty()) options.scenes = scene_names();
  if (options.rays.empty()) options.rays = {"primary", "shadow", "diffuse"};
  for (const Part& part : parts) {
    const bool is_wanted = wanted.empty() || std::find(wanted.begin(), wanted.end(), part.name) != wanted.end();
    if (!is_wanted) continue;
    if (const int status = run(part, options); status != 0) return status;
  }
  return 0;
}
