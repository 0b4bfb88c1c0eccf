// Copies of a part, side by side, turned and now and then through one another: so many primitives that it is stored once.
include <stage.scad>

side = 48;

module part() {
  difference() {
    cube([0.8, 0.8, 0.8]);
    for (i = [0:3], j = [0:2]) translate([0.1 + 0.2 * i, 0.2 + 0.2 * j, 0.8]) sphere(0.08);
    translate([0.4, 0.4, -1]) cylinder(h = 3, r = 0.2);
    translate([0.4, -1, 0.3]) rotate([-90, 0, 0]) cylinder(h = 3, r = 0.1);
  }
  translate([0.4, 0.4, 0.4]) sphere(0.15);
  translate([0.1, 0.1, 0.8]) cylinder(h = 0.1, r = 0.1);
  translate([0.7, 0.7, 0.8]) cylinder(h = 0.1, r = 0.1);
  translate([0.4, 0.4, 0.8]) torus(0.25, 0.05);
}

stage(-0.5, from = [0, -30, 22], at = [0, -3, 0])
  for (i = [0:side - 1], j = [0:side - 1])
    translate([i - side / 2, j - side / 2, -0.5]) rotate([0, 0, 90 * ((i + 2 * j) % 4) + (j % 3 == 0 ? 20 : 0)])
      translate([-0.4, -0.4, 0]) part();
