// The small shell as a recursion, which builds the lopsided tree of Zajíček 2012 (figure 2.2): each union holds one
// segment and the whole rest of the shell.
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

module lopsided_small_shell(segments) {
  segment();
  if (segments > 1) scale(0.93) rotate([0, 0, 22.5]) lopsided_small_shell(segments - 1);
}

clay([0.93, 0.72, 0.55]) lopsided_small_shell(16);

ground(-1.05);
studio_lights();
camera(from = [-3.5, -7, 5], at = [0.5, -0.7, -0.1], fov = 40);
