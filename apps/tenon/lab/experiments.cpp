#include "lab/experiments.h"

namespace tenon {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{
      {"rr612-1", "rr612", 1, run_rr612_scenes},
      {"rr612-2", "rr612", 60, run_rr612_gain},
      {"rr612-3", "rr612", 15, run_rr612_statistics},
      {"rr612-4", "rr612", 40, run_rr612_growth},
      {"rr612-memory", "rr612", 10, run_rr612_memory},
      {"rope-trees-2", "rope-trees", 60, run_rope_trees_diffuse},
      {"rope-trees-specular", "rope-trees", 180, run_rope_trees_specular},
      {"course-hierarchies", "course", 60, run_course_hierarchies},
      {"course-volumes", "course", 30, run_course_volumes},
      {"course-polygons", "course", 10, run_course_polygons},
      {"course-roots", "course", 60, run_course_roots},
      {"course-patches", "course", 60, run_course_patches},
      {"course-steps", "course", 10, run_course_steps},
      {"course-grids", "course", 15, run_course_grids},
      {"okd-1", "okd", 90, run_okd_grooved_sphere},
      {"okd-2", "okd", 90, run_okd_checkered_cube},
      {"okd-3", "okd", 90, run_okd_large_shell},
      {"okd-4", "okd", 90, run_okd_small_shell},
      {"okd-turns", "okd", 60, run_okd_turns},
      {"okd-finer", "okd", 30, run_okd_finer},
      {"scaling-size", "scaling", 200, run_scaling_size},
      {"scaling-stadium", "scaling", 30, run_scaling_stadium},
      {"scaling-overlap", "scaling", 60, run_scaling_overlap},
      {"scaling-balance", "scaling", 20, run_scaling_balance},
      {"scaling-depth", "scaling", 60, run_scaling_depth},
      {"work", "work", 30, run_work_heat_maps},
  };
  return all;
}

}  // namespace tenon
