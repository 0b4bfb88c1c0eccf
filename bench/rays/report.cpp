#include "rays/report.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>

#include "tenon/base/atomic_file.h"

namespace tenon::bench {

std::string results_folder() {
  std::filesystem::create_directories("build/bench/results");
  return "build/bench/results";
}

Report::Report(std::string part) : part_(std::move(part)) {
  std::printf("\n== %s\n", part_.c_str());
}

void Report::heading(const std::string& text) {
  std::printf("\n%s\n", text.c_str());
  std::fflush(stdout);
}

void Report::note(const std::string& text) {
  std::printf("  %s\n", text.c_str());
  rows_.push_back({{"note", text}});
  std::fflush(stdout);
}

void Report::rate(const std::string& scene, const std::string& rays, const Timing& timing, std::size_t count,
                  const Timing* against) {
  const double rate = static_cast<double>(count) / timing.median() / 1e6;
  std::printf("  %-16s %-8s %-28s %9.3f Mrays/s  +-%4.1f %%", scene.c_str(), rays.c_str(), timing.name.c_str(), rate,
              100 * timing.spread());
  nlohmann::ordered_json row{{"scene", scene},
                             {"rays", rays},
                             {"contender", timing.name},
                             {"mrays_per_second", rate},
                             {"seconds", timing.seconds}};
  if (against != nullptr && against != &timing) {
    const double times = ratio(timing, *against);
    std::printf("  %s is %.2f times as fast", against->name.c_str(), times);
    row["ratio"] = times;
  }
  std::printf("\n");
  std::fflush(stdout);
  rows_.push_back(std::move(row));
}

void Report::figure(const std::string& scene, const std::string& name, double value, const std::string& unit) {
  std::printf("  %-16s %-50s %12.6g %s\n", scene.c_str(), name.c_str(), value, unit.c_str());
  std::fflush(stdout);
  rows_.push_back({{"scene", scene}, {"figure", name}, {"value", value}, {"unit", unit}});
}

void Report::summary(const std::string& what, const std::vector<double>& ratios) {
  if (ratios.empty()) return;
  const double mean = geometric_mean(ratios), least = *std::min_element(ratios.begin(), ratios.end());
  std::printf("  %-54s geometric mean %6.2f, least %6.2f\n", what.c_str(), mean, least);
  std::fflush(stdout);
  rows_.push_back({{"summary", what}, {"geometric_mean", mean}, {"least", least}, {"ratios", ratios}});
}

Status Report::save() const {
  Result<AtomicFile> file = AtomicFile::create(results_folder() + "/" + part_ + ".json");
  if (!file) return file.error();
  if (Status status = file->write(rows_.dump(2) + "\n"); !status) return status;
  return file->commit();
}

}  // namespace tenon::bench
