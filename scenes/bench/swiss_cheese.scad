// A box less 1,000 spheres of radius 0.04 to 0.12 anywhere in it, which overlap.
include <stage.scad>
use <lehmer.scad>

spheres = 1000;
u = lehmer(12345, 4 * spheres);

stage(ground = -1.05, from = [3, -4.4, 3], at = [0, 0, -0.05]) difference() {
  cube(2, center = true);
  for (i = [0 : spheres - 1])
    translate([2 * u[4 * i] - 1, 2 * u[4 * i + 1] - 1, 2 * u[4 * i + 2] - 1]) sphere(0.04 + 0.08 * u[4 * i + 3]);
}
