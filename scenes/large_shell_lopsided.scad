// The large shell as a recursion: the lopsided tree of Zajíček 2012 (figure 2.2), 65 unions deep.
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

module lopsided_large_shell(segments) {
  segment();
  if (segments > 1) scale(0.979) rotate([0, 0, 12]) lopsided_large_shell(segments - 1);
}

clay([0.55, 0.70, 0.78]) lopsided_large_shell(65);

ground(-1.05);
studio_lights();
camera(from = [4, -10, 8], at = [0.5, 0.4, -0.2], fov = 40);
