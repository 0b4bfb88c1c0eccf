// A plate with a boss, teeth, holes and slots, as machined parts are: 200 boxes, cylinders and cones.
include <stage.scad>

module pin(x, y, z0, z1, r) { translate([x, y, z0]) cylinder(h = z1 - z0, r = r); }
module block(lower, upper) { translate(lower) cube(upper - lower); }

module body() {
  block([-2.7, -2, 0], [2.7, 2, 0.3]);
  block([-3, -1.7, 0], [3, 1.7, 0.3]);
  for (x = [-2.7, 2.7], y = [-1.7, 1.7]) pin(x, y, 0, 0.3, 0.3);
  pin(0, 0, 0.1, 0.65, 1.2);
  for (i = [0:39]) rotate([0, 0, 9 * i]) block([1.1, -0.05, 0.12], [1.4, 0.05, 0.62]);
  pin(0, 0, 0.2, 1, 0.45);
}

module bore() {
  pin(0, 0, -1, 2, 0.22);
  block([0.15, -0.06, -1], [0.30, 0.06, 2]);
  for (i = [0:7]) rotate([0, 0, 45 * i + 22.5]) pin(0.335, 0, 0.8, 1.1, 0.05);
  for (i = [0:7]) rotate([0, 0, 45 * i]) pin(0.8, 0, -1, 2, 0.17);
}

module holes() {
  for (s = [-1, 1], i = [0:4], j = [0:8]) pin(s * (1.66 + 0.25 * i), -1.28 + 0.32 * j, -1, 1, 0.07);
  for (x = [-2.7, 2.7], y = [-1.7, 1.7]) {
    pin(x, y, -1, 1, 0.09);
    translate([x, y, 0.15]) cylinder(h = 0.2, r1 = 0.05, r2 = 0.25);
  }
}

module slots() {
  for (s = [-1, 1], i = [0:5]) {
    x = -1.5 + 0.6 * i;
    y = s * 1.75;
    block([x - 0.18, y - 0.06, -1], [x + 0.18, y + 0.06, 1]);
    pin(x - 0.18, y, -1, 1, 0.06);
    pin(x + 0.18, y, -1, 1, 0.06);
  }
}

stage(ground = -0.2, from = [3.2, -6.8, 5.6], at = [0, -0.1, 0.2]) difference() {
  body();
  bore();
  holes();
  slots();
}
