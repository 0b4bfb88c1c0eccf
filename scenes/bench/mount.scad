// A mount as people model it: hulls, rounded and straight extrusions, hexagonal holes, countersinks and tapered bosses.
include <stage.scad>

module plate() {
  hull() for (x = [-2.5, 2.5], y = [-1.5, 1.5]) translate([x, y, 0]) cylinder(h = 0.3, r = 0.5);
  for (x = [-2, 2]) hull() {
    translate([x, 0, 0.3]) cube([0.4, 2.6, 0.01], center = true);
    translate([x, 0.6, 1.4]) rotate([0, 90, 0]) cylinder(h = 0.4, r = 0.45, center = true);
  }
  for (x = [-1.2:0.6:1.2], y = [-1.2, 1.2]) translate([x, y, 0.3]) cylinder(h = 0.5, r1 = 0.22, r2 = 0.14);
  translate([0, 0, 0.3]) linear_extrude(0.35) offset(r = 0.2) square([1.4, 0.9], center = true);
  translate([0, -0.1, 0.65]) linear_extrude(0.12)
    polygon([for (i = [0:15]) (i % 2 == 0 ? 0.42 : 0.26) * [cos(22.5 * i), sin(22.5 * i)]]);
}

module holes() {
  for (x = [-2.5, 2.5], y = [-1.5, 1.5]) translate([x, y, 0]) {
    cylinder(h = 1, r = 0.16, center = true);
    translate([0, 0, 0.12]) cylinder(h = 0.2, r1 = 0.16, r2 = 0.36);
  }
  for (x = [-1.2:0.6:1.2], y = [-1.2, 1.2]) translate([x, y, 0.2]) cylinder(h = 1, r = 0.08, $fn = 6);
  translate([0, 0.6, 1.4]) rotate([0, 90, 0]) cylinder(h = 6, r = 0.18, center = true);
  for (s = [-1, 1])
    translate([s * 2.2, 0.6, 1.4]) rotate([0, s * 90, 0]) cylinder(h = 0.3, r = 0.32, $fn = 6, center = true);
  for (s = [-1, 1], i = [0:4])
    translate([0.5 * (i - 2), 0.72 * s, -0.1]) linear_extrude(0.6) offset(r = 0.06) square([0.1, 0.24], center = true);
  translate([0, -0.1, 0]) cylinder(h = 2, r = 0.15);
}

stage(ground = -0.2, from = [4.2, -8.6, 7], at = [0, -0.1, 0.3]) difference() {
  plate();
  holes();
}
