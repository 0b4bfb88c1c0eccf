#include "lab/experiments.h"

namespace tenon {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{
      {"rr612-1", "rr612", 1, run_rr612_scenes},       {"rr612-2", "rr612", 60, run_rr612_gain},
      {"rr612-3", "rr612", 15, run_rr612_statistics},  {"rr612-4", "rr612", 40, run_rr612_growth},
      {"rr612-memory", "rr612", 10, run_rr612_memory},
  };
  return all;
}

}  // namespace tenon
