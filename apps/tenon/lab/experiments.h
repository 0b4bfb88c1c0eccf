#pragma once

#include <vector>

#include "lab/lab.h"
#include "lab/lab_table.h"
#include "lab/paper.h"

namespace tenon {

/// What measures one table.
struct Experiment {
  const char* id;     ///< of the table, such as "rr612-3"
  const char* paper;  ///< Paper::id; also the name of the page
  double weight;      ///< about how many seconds it takes at full effort, on two cores
  /// Fills columns, rows, plots and claims; id and paper are known.
  Status (*run)(Lab& lab, const Paper& paper, LabTable& table);
};

/// Every experiment, in the order of the pages.
const std::vector<Experiment>& experiments();

Status run_rr612_scenes(Lab& lab, const Paper& paper, LabTable& table);
Status run_rr612_gain(Lab& lab, const Paper& paper, LabTable& table);
Status run_rr612_statistics(Lab& lab, const Paper& paper, LabTable& table);
Status run_rr612_growth(Lab& lab, const Paper& paper, LabTable& table);
Status run_rr612_levels(Lab& lab, const Paper& paper, LabTable& table);
Status run_rope_trees_diffuse(Lab& lab, const Paper& paper, LabTable& table);
Status run_rope_trees_specular(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_hierarchies(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_volumes(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_polygons(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_roots(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_patches(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_steps(Lab& lab, const Paper& paper, LabTable& table);
Status run_course_grids(Lab& lab, const Paper& paper, LabTable& table);
Status run_okd_grooved_sphere(Lab& lab, const Paper& paper, LabTable& table);
Status run_okd_checkered_cube(Lab& lab, const Paper& paper, LabTable& table);
Status run_okd_large_shell(Lab& lab, const Paper& paper, LabTable& table);
Status run_okd_small_shell(Lab& lab, const Paper& paper, LabTable& table);
Status run_okd_turns(Lab& lab, const Paper& paper, LabTable& table);
Status run_okd_finer(Lab& lab, const Paper& paper, LabTable& table);
Status run_scaling_size(Lab& lab, const Paper& paper, LabTable& table);
Status run_scaling_stadium(Lab& lab, const Paper& paper, LabTable& table);
Status run_scaling_overlap(Lab& lab, const Paper& paper, LabTable& table);
Status run_scaling_balance(Lab& lab, const Paper& paper, LabTable& table);
Status run_scaling_depth(Lab& lab, const Paper& paper, LabTable& table);
Status run_work_heat_maps(Lab& lab, const Paper& paper, LabTable& table);

}  // namespace tenon
