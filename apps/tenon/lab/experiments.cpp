#include "lab/experiments.h"

namespace tenon {

const std::vector<Experiment>& experiments() {
  static const std::vector<Experiment> all{
      {"rr612-1", "rr612", 1, run_rr612_scenes},
      {"rr612-2", "rr612", 24, run_rr612_gain},
      {"rr612-3", "rr612", 25, run_rr612_statistics},
      {"rr612-4", "rr612", 4, run_rr612_growth},
      {"rr612-levels", "rr612", 20, run_rr612_levels},
      {"rope-trees-2", "rope-trees", 42, run_rope_trees_diffuse},
      {"rope-trees-specular", "rope-trees", 106, run_rope_trees_specular},
      {"course-hierarchies", "course", 28, run_course_hierarchies},
      {"course-volumes", "course", 8, run_course_volumes},
      {"course-polygons", "course", 6, run_course_polygons},
      {"course-roots", "course", 2, run_course_roots},
      {"course-patches", "course", 2, run_course_patches},
      {"course-steps", "course", 20, run_course_steps},
      {"course-grids", "course", 13, run_course_grids},
      {"okd-1", "okd", 190, run_okd_grooved_sphere},
      {"okd-2", "okd", 125, run_okd_checkered_cube},
      {"okd-3", "okd", 135, run_okd_large_shell},
      {"okd-4", "okd", 240, run_okd_small_shell},
      {"okd-turns", "okd", 58, run_okd_turns},
      {"okd-finer", "okd", 14, run_okd_finer},
      {"scaling-size", "scaling", 150, run_scaling_size},
      {"scaling-stadium", "scaling", 70, run_scaling_stadium},
      {"scaling-overlap", "scaling", 55, run_scaling_overlap},
      {"scaling-balance", "scaling", 15, run_scaling_balance},
      {"scaling-depth", "scaling", 130, run_scaling_depth},
      {"work", "work", 10, run_work_heat_maps},
  };
  return all;
}

}  // namespace tenon
