// The small shell of Zajíček 2012 (§4.5, attachment 1): 16 segments, each a hollow sphere cut by two boxes.
include <studio.scad>

module segment() {
  difference() {
    translate([0, -2, 0]) sphere(1);
    union() {
      translate([0, -2, 0]) scale(0.95) sphere(1);
      rotate([0, 0, 18]) scale(10) translate([0, -0.5, -0.5]) cube(1);
      rotate([0, 0, 162]) scale(10) translate([0, -0.5, -0.5]) cube(1);
    }
  }
}

module small_shell() {
  for (i = [0:15]) scale(pow(0.93, i)) rotate([0, 0, 22.5 * i]) segment();
}

clay([0.93, 0.72, 0.55]) small_shell();

ground(-1.05);
studio_lights();
camera(from = [-3.5, -7, 5], at = [0.5, -0.7, -0.1], fov = 40);
