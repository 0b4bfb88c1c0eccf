// The checkered cube of Zajíček 2012 (§4.4, attachment 1): a cube with a 5 x 5 grid of cubes cut into each face.
include <studio.scad>

module small_cube() { translate([0.8, 0.8, 1.1]) scale(0.2) translate([-0.5, -0.5, -0.5]) cube(1); }
module row() { for (i = [0:4]) translate([-0.4 * i, 0, 0]) small_cube(); }
module grid() { for (i = [0:4]) translate([0, -0.4 * i, 0]) row(); }
module lattice() {
  grid();
  rotate([90, 0, 0]) grid();
  rotate([180, 0, 0]) grid();
  rotate([270, 0, 0]) grid();
  rotate([0, 90, 0]) grid();
  rotate([0, 270, 0]) grid();
}

module checkered_cube() {
  difference() {
    scale(2.2) translate([-0.5, -0.5, -0.5]) cube(1);
    lattice();
  }
}

clay([0.80, 0.42, 0.30]) checkered_cube();

ground(-1.15);
studio_lights();
camera(from = [3.4, -5, 3.4], at = [0, 0, -0.05], fov = 40);
