// Made to IMA2 of Bouatouch et al. 1987 (RR-612, table 1): 72 spheres and cylinders, one light, ray tree of depth 1.
// A double helix: 24 rungs of two spheres and a cylinder. `-D primitives=36` (24, 12, 8) leaves out the rest, as for the
// paper's table 4.
include <tenon.scad>

primitives = 72;
rungs = 24;
turn = 30;
rise = 0.34;
radius = 1.15;

module ball(tint) {
  material("ball", model = "phong", kd = 0.72, ks = 0.28, shininess = 70, color = tint)
    translate([radius, 0, 0]) sphere(0.36);
}
module rung() {
  material("rung", model = "phong", kd = 0.8, ks = 0.2, shininess = 40, color = [0.88, 0.86, 0.80])
    rotate([0, 90, 0]) cylinder(h = 2 * radius, r = 0.11, center = true);
}

rotate([0, 66, -14]) for (k = [0 : primitives - 1]) {
  step = floor(k / 3);
  part = k % 3;
  translate([0, 0, (step - (rungs - 1) / 2) * rise]) rotate([0, 0, turn * step]) {
    if (part == 0) ball([0.86, 0.30, 0.22]);
    if (part == 1) rotate([0, 0, 180]) ball([0.16, 0.46, 0.66]);
    if (part == 2) rung();
  }
}

light(type = "point", position = [5, -9, 12], intensity = 1.1);
ambient(0.58);
background([0.94, 0.94, 0.92]);
camera(from = [0.4, -10.5, 4.2], at = [0.1, 0, 0.1], fov = 46);
