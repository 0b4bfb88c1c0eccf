#pragma once

#include <algorithm>
#include <vector>

#include "lab/claim.h"
#include "tenon/base/timing.h"

namespace tenon {

/// Ratios of one kind over several scenes.
class Ratios {
 public:
  void add(const Measured& ratio) { all_.push_back(ratio); }
  bool empty() const { return all_.empty(); }

  /// The geometric mean, with the largest spread.
  Measured mean() const {
    std::vector<double> values;
    double spread = 0;
    for (const Measured& m : all_) values.push_back(m.value), spread = std::max(spread, m.spread);
    return {geometric_mean(values), spread};
  }
  Measured least() const { return *std::min_element(all_.begin(), all_.end(), less); }
  Measured largest() const { return *std::max_element(all_.begin(), all_.end(), less); }

 private:
  static bool less(const Measured& a, const Measured& b) { return a.value < b.value; }

  std::vector<Measured> all_;
};

}  // namespace tenon
