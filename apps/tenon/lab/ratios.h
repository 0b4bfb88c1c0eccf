#pragma once

#include <algorithm>
#include <vector>

#include "lab/measured.h"
#include "tenon/base/timing.h"

namespace tenon {

/// Ratios of one kind over several scenes.
class Ratios {
 public:
  void add(const Measured& ratio) { all_.push_back(ratio); }

  /// The geometric mean. Its logarithm is the mean of logarithms, so it is off by no more than the mean of the spreads.
  Measured mean() const {
    std::vector<double> values;
    double spread = 0;
    for (const Measured& m : all_) values.push_back(m.value), spread += m.spread / static_cast<double>(all_.size());
    return {geometric_mean(values), spread};
  }
  Measured least() const { return *std::min_element(all_.begin(), all_.end(), less); }
  Measured largest() const { return *std::max_element(all_.begin(), all_.end(), less); }

 private:
  static bool less(const Measured& a, const Measured& b) { return a.value < b.value; }

  std::vector<Measured> all_;
};

}  // namespace tenon
