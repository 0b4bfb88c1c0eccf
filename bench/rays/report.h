#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "rays/measure.h"

namespace tenon::bench {

/// What a part prints, and keeps for its JSON file. Lines appear as they are measured.
class Report {
 public:
  explicit Report(std::string part);

  /// Under what the following lines are measured.
  void heading(const std::string& text);
  void note(const std::string& text);
  /// A contender's rate: the median of the rounds, its spread, and how it stands to another's.
  void rate(const std::string& scene, const std::string& rays, const Timing& timing, std::size_t count,
            const Timing* against = nullptr);
  /// Any other figure.
  void figure(const std::string& scene, const std::string& name, double value, const std::string& unit);
  /// How many times faster, on each scene: the geometric mean and the least of them.
  void summary(const std::string& what, const std::vector<double>& ratios);

  /// Writes build/bench/PART.json.
  Status save() const;

 private:
  std::string part_;
  nlohmann::ordered_json rows_ = nlohmann::ordered_json::array();
};

/// Where results and pictures go.
std::string results_folder();

}  // namespace tenon::bench
