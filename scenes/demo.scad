// A puzzle ball: shells that turn freely inside each other, carved from one piece. Every hole is a cone from the centre,
// and every cut is exact.
include <tenon.scad>

golden = (1 + sqrt(5)) / 2;
// The twelve corners of an icosahedron.
corners = [for (s = [-1, 1], t = [-1, 1]) each [[0, s, t * golden], [s, t * golden, 0], [t * golden, 0, s]]];

module towards(direction) {
  rotate([0, acos(direction.z / norm(direction)), atan2(direction.y, direction.x)]) children();
}

module shell(outer, thickness, opening) {
  difference() {
    sphere(outer);
    sphere(outer - thickness);
    for (c = corners) towards(c) cylinder(h = outer * 1.1, r1 = 0, r2 = outer * 1.1 * opening);
  }
}

tints = [[0.93, 0.87, 0.76], [0.80, 0.30, 0.22], [0.93, 0.72, 0.30], [0.24, 0.62, 0.64]];
radii = [2.0, 1.64, 1.30, 0.98];

for (i = [0 : len(radii) - 1])
  material("carved", model = "phong", kd = 0.78, ks = 0.22, shininess = 60, color = tints[i])
    rotate([7 * i, -9 * i, 11 * i]) shell(radii[i], 0.17, 0.46);
material("pearl", model = "phong", kd = 0.8, ks = 0.2, shininess = 150, color = [0.97, 0.94, 0.90]) sphere(0.55);

// A stand of rings.
material("brass", model = "whitted", kd = 0.72, ks = 0.28, shininess = 120, color = [0.80, 0.58, 0.22]) {
  translate([0, 0, -1.78]) torus(R = 1.02, r = 0.11);
  translate([0, 0, -2.12]) torus(R = 1.35, r = 0.16);
}
material("floor", model = "whitted", kd = 0.88, ks = 0.12, shininess = 80, color = [0.36, 0.38, 0.42])
  translate([-40, -40, -2.78]) cube([80, 80, 0.5]);

light(type = "point", position = [7, -9, 12], intensity = 1.0, color = [1, 0.96, 0.9]);
light(type = "point", position = [-11, -6, 6], intensity = 0.45, color = [0.86, 0.92, 1]);
light(type = "point", position = [0, 0, 0.7], intensity = 0.35, color = [1, 0.85, 0.6]);
ambient(0.46);
background([0.80, 0.85, 0.90]);
camera(from = [4.6, -7.6, 2.4], at = [0, 0, -0.35], fov = 40);
