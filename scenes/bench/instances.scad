// A million copies of a part of nineteen primitives, stored once:
//   tenon info scenes/bench/instances.scad --accel cells
n = 1000;  // to a side

module part() {
  difference() {
    cube([0.8, 0.8, 0.8]);
    for (i = [0:3], j = [0:2]) translate([0.1 + 0.2 * i, 0.1 + 0.2 * j, 0.8]) sphere(0.08);
    translate([0.4, 0.4, -1]) cylinder(h = 3, r = 0.2);
    translate([0.4, -1, 0.3]) rotate([-90, 0, 0]) cylinder(h = 3, r = 0.1);
  }
  translate([0.4, 0.4, 0.4]) sphere(0.15);
  translate([0, 0, 0.8]) cylinder(h = 0.1, r = 0.1);
  translate([0.8, 0.8, 0.8]) cylinder(h = 0.1, r = 0.1);
  translate([0.4, 0.4, 0.8]) torus(0.25, 0.05);
}

for (i = [0:n - 1], j = [0:n - 1]) translate([i, j, 0]) rotate([0, 0, 13 * i + 7 * j]) part();
