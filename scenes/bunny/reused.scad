// One bunny reused by transformations and Booleans (Figure 3.2 of Zajíček 2012): stored once, whole, cut open, as a
// mould, and as what two of them share. `./dev bunny` gets the mesh.
include <tenon.scad>

module bunny() import("../../build/bunny.off");

module shown(at, rgb) translate(at) color(rgb) children();

material("matte", kd = 0.9, ks = 0.1) {
  shown([-12, 0, 0], [0.85, 0.75, 0.65]) bunny();
  shown([0, 0, 0], [0.75, 0.45, 0.35]) difference() {
    bunny();
    translate([0.6, -0.4, 0.3]) scale(0.9) bunny();
    translate([-6, -8, -1]) cube([12, 8, 12]);
  }
  shown([12, 0, 0], [0.45, 0.6, 0.75]) difference() {
    translate([-5.5, 0.2, -0.5]) cube([11, 4.5, 10.8]);
    bunny();
  }
  shown([6, -12, 0], [0.6, 0.7, 0.45]) intersection() {
    bunny();
    rotate([0, 0, 90]) bunny();
    translate([-6, -6, 0]) cube([12, 12, 7.2]);
  }
  shown([-6, -12, 0], [0.8, 0.65, 0.3]) difference() {
    bunny();
    for (z = [1 : 2 : 9], x = [-4 : 2 : 4]) translate([x, -3, z]) sphere(0.9);
    for (z = [1 : 2 : 9], x = [-4 : 2 : 4]) translate([x, 0, z]) sphere(0.9);
  }
}
material("matte") color([0.55, 0.58, 0.55]) translate([-200, -200, -1.5]) cube([400, 400, 1]);
light(type = "point", position = [20, -35, 40], intensity = 0.7);
light(type = "point", position = [-40, -25, 18], intensity = 0.25);
camera(from = [2, -54, 30], at = [1, -4, 3], fov = 38);
background([0.86, 0.9, 0.94]);
ambient([0.3, 0.33, 0.4]);
