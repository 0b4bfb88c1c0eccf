// The large shell of Zajíček 2012 (§4.5, attachment 1): 65 segments, each a sphere less two that are nearly as large.
include <studio.scad>

hollow = 0.989227963463;

module segment() {
  translate([3, 0, 0]) difference() {
    sphere(1);
    union() {
      scale(hollow) translate([0, -0.02, 0]) sphere(1);
      scale(hollow) translate([0, 0.02, 0]) sphere(1);
    }
  }
}

module large_shell() {
  for (i = [0:64]) scale(pow(0.979, i)) rotate([0, 0, 12 * i]) segment();
}

clay([0.55, 0.70, 0.78]) large_shell();

ground(-1.05);
studio_lights();
camera(from = [4, -10, 8], at = [0.5, 0.4, -0.2], fov = 40);
