// The grooved sphere of Zajíček 2012 (§4.3, attachment 1): a sphere and six tori, whose boxes all overlap.
include <studio.scad>

module groove() { translate([0, 0, 0.374]) scale(0.9) torus(R = 1, r = 0.1); }
module groove_pair() { groove(); rotate([0, 180, 0]) groove(); }

module grooved_sphere() {
  difference() {
    sphere(1);
    union() {
      groove_pair();
      rotate([0, 90, 0]) groove_pair();
      rotate([90, 0, 0]) groove_pair();
    }
  }
}

clay() grooved_sphere();

ground(-1.05);
studio_lights();
camera(from = [2.6, -3.6, 2.2], at = [0, 0, 0], fov = 40);
