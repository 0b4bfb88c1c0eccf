// Pencils, sharpened by cutting. A sharpener of steel would leave steel wherever it cuts; cut_faces("base") shows what
// the pencil is made of there: paint, wood and lead.
include <tenon.scad>

module paint(tint) material("paint", model = "whitted", kd = 0.9, ks = 0.1, shininess = 120, color = tint) children();
module wood() material("wood", model = "phong", kd = 0.95, ks = 0.05, color = [0.87, 0.70, 0.48]) children();
module lead() material("lead", model = "phong", kd = 0.8, ks = 0.2, shininess = 30, color = [0.16, 0.16, 0.18]) children();
module brass() material("brass", model = "whitted", kd = 0.7, ks = 0.3, shininess = 120, color = [0.85, 0.65, 0.30]) children();
module rubber() material("rubber", model = "phong", kd = 0.95, ks = 0.05, color = [0.88, 0.52, 0.50]) children();

module steel() material("steel", model = "whitted", kd = 0.4, ks = 0.6, color = [0.8, 0.8, 0.82]) children();

// Everything around a cone: what a sharpener takes away. The tip of the cone is at the origin, and it opens along z.
module sharpener(opening) {
  difference() {
    translate([0, 0, -1]) cylinder(h = 40, r = 8);
    cylinder(h = 39, r1 = 0, r2 = 39 * opening);
  }
}

// Along z, its tip at the origin.
module pencil(tint, length = 90) {
  cut_faces("base") difference() {
    union() {
      lead() cylinder(h = length, r = 1.1);
      wood() cylinder(h = length, r = 3.4, $fn = 6);
      paint(tint) cylinder(h = length, r = 3.7, $fn = 6);
    }
    steel() sharpener(0.19);
  }
  brass() translate([0, 0, length]) difference() {
    cylinder(h = 9, r = 3.8);
    for (z = [2 : 1.2 : 6.8]) translate([0, 0, z]) torus(R = 4.1, r = 0.5);
  }
  rubber() translate([0, 0, length + 9]) intersection() {
    cylinder(h = 8, r = 3.4);
    translate([0, 0, -12]) sphere(20);
  }
}

tints = [[0.80, 0.16, 0.14], [0.95, 0.72, 0.15], [0.16, 0.45, 0.32], [0.15, 0.36, 0.66], [0.45, 0.20, 0.50]];
for (i = [0 : len(tints) - 1])
  translate([(i - 2) * 13, 4 * (i % 2), 3.3]) rotate([-90, 0, (i - 2) * -4]) rotate(30 + 7 * i) pencil(tints[i], 60);

material("table", model = "whitted", kd = 0.93, ks = 0.07, shininess = 40, color = [0.80, 0.79, 0.76])
  translate([-400, -400, -10]) cube([800, 800, 10]);
light(position = [-120, -60, 160], intensity = 0.8, color = [1, 0.97, 0.92]);
light(position = [140, -120, 90], intensity = 0.3, color = [0.9, 0.95, 1]);
ambient(0.5);
background([0.86, 0.90, 0.95]);
camera(from = [22, -72, 66], at = [2, 24, 2], fov = 40);
