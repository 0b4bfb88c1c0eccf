// Made to IMA1 of Bouatouch et al. 1987 (RR-612, table 1): 32 primitives (spheres, cylinders, cubes, cones), three
// lights, ray tree of depth 1. A toy locomotive.
include <tenon.scad>

module paint(tint, gloss = 0.2) {
  material("paint", model = "phong", kd = 1 - gloss, ks = gloss, shininess = 60, color = tint) children();
}
module axle(length) { rotate([90, 0, 0]) cylinder(h = length, r = 1, center = true); }

// A wheel of unit radius with a hole for its axle: 2 primitives.
module wheel(radius) {
  difference() {
    scale([radius, 0.16, radius]) axle(1);
    scale([0.35 * radius, 0.2, 0.35 * radius]) axle(1);
  }
}

// A base plate, no larger than the model needs (the whole space is subdivided), and the frame: 2.
paint([0.66, 0.74, 0.60], 0) translate([-4, -3, -0.25]) cube([8, 6, 0.25]);
paint([0.20, 0.22, 0.26]) translate([-2.3, -0.55, 0.6]) cube([4.5, 1.1, 0.22]);

// Boiler, dome and chimney, which is hollow: 5.
paint([0.12, 0.42, 0.32], 0.3) translate([-0.7, 0, 1.35]) rotate([0, 90, 0]) cylinder(h = 2.7, r = 0.6);
paint([0.85, 0.65, 0.22], 0.4) translate([0.3, 0, 1.9]) sphere(0.3);
paint([0.20, 0.22, 0.26]) difference() {
  translate([1.4, 0, 1.8]) cylinder(h = 0.9, r1 = 0.16, r2 = 0.34);
  translate([1.4, 0, 2.0]) cylinder(h = 1, r = 0.14);
}
paint([0.85, 0.65, 0.22], 0.4) translate([1.98, 0, 1.35]) rotate([0, 90, 0]) cylinder(h = 0.12, r = 0.5);

// Cabin with a room, a round window and a vaulted roof: 5.
paint([0.70, 0.20, 0.16], 0.25) difference() {
  translate([-2.2, -0.7, 0.82]) cube([1.5, 1.4, 1.6]);
  translate([-2.4, -0.58, 0.95]) cube([1.5, 1.16, 1.3]);
  translate([-1.35, 0, 1.95]) scale([0.3, 2, 0.3]) axle(1);
}
paint([0.85, 0.65, 0.22], 0.3) intersection() {
  translate([-1.45, 0, 1.6]) rotate([0, 90, 0]) cylinder(h = 1.9, r = 1.15, center = true);
  translate([-2.6, -1, 2.42]) cube([2.4, 2, 0.5]);
}

// Wheels, small in front and large behind: 12.
paint([0.70, 0.20, 0.16], 0.25) for (side = [-1, 1]) {
  translate([-1.5, 0.72 * side, 0.62]) wheel(0.62);
  translate([0.1, 0.72 * side, 0.45]) wheel(0.45);
  translate([1.3, 0.72 * side, 0.45]) wheel(0.45);
}

// Lamp, buffers and cowcatcher: 5.
paint([0.98, 0.92, 0.70], 0.4) translate([2.15, 0, 1.75]) sphere(0.17);
paint([0.85, 0.65, 0.22], 0.4) for (side = [-1, 1])
  translate([2.2, 0.38 * side, 0.72]) rotate([0, 90, 0]) cylinder(h = 0.3, r = 0.12);
paint([0.20, 0.22, 0.26]) intersection() {
  translate([2.2, 0, 0.05]) cylinder(h = 0.75, r1 = 0.8, r2 = 0.2);
  translate([2.2, -1, 0.06]) cube([1, 2, 0.5]);
}
// A whistle, a safety valve and a bell make it 32.
paint([0.85, 0.65, 0.22], 0.4) translate([-0.3, 0, 1.9]) cylinder(h = 0.35, r1 = 0.08, r2 = 0.05);
paint([0.85, 0.65, 0.22], 0.4) translate([0.8, 0, 1.93]) sphere(0.13);
paint([0.85, 0.65, 0.22], 0.4) translate([-0.05, 0, 1.92]) cylinder(h = 0.25, r1 = 0.14, r2 = 0.04);

light(type = "point", position = [6, -9, 11], intensity = 0.95, color = [1, 0.96, 0.9]);
light(type = "point", position = [-9, -7, 7], intensity = 0.45, color = [0.88, 0.94, 1]);
light(type = "point", position = [3, 9, 9], intensity = 0.3);
ambient(0.52);
background([0.80, 0.88, 0.94]);
camera(from = [5.6, -7.2, 4.2], at = [-0.1, 0, 1.1], fov = 38);
