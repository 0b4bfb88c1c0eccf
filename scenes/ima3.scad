// Made to IMA3 of Bouatouch et al. 1987 (RR-612, table 1): 12 spheres, cylinders and cubes, two lights, rays followed
// five deep (render with --depth 5). Glass, mirror and water on a table.
include <tenon.scad>

// The table and a mirror that stands behind it: 2.
material("table", model = "whitted", kd = 0.86, ks = 0.14, shininess = 30, color = [0.50, 0.36, 0.26])
  translate([-6, -6, -0.3]) cube([12, 12, 0.3]);
material("mirror", model = "whitted", kd = 0.08, ks = 0.92, shininess = 400, color = [0.8, 0.85, 0.9])
  translate([-3.2, 2.6, 0]) rotate([4, 0, 8]) cube([6.4, 0.12, 3.4]);

// A tumbler of glass with water in it, and a ball of glass: 4. The water touches the glass: no gap, no double wall.
material("glass", model = "whitted", kd = 0.02, ks = 0.08, kt = 0.9, ior = 1.5, shininess = 300, color = [0.9, 1, 0.97])
  translate([-1.5, -0.6, 0]) difference() {
    cylinder(h = 1.9, r = 0.72);
    translate([0, 0, 0.16]) cylinder(h = 2, r = 0.62);
  }
material("water", model = "whitted", kd = 0.02, ks = 0.06, kt = 0.92, ior = 1.33, shininess = 300, color = [0.8, 0.9, 1])
  translate([-1.5, -0.6, 0.16]) cylinder(h = 1.0, r = 0.62);
material("ball", model = "whitted", kd = 0.02, ks = 0.08, kt = 0.9, ior = 1.5, shininess = 300, color = [1, 1, 1])
  translate([0.55, -1.3, 0.62]) sphere(0.62);

// A mirror ball, and a die with round corners and a bore: 4.
material("chrome", model = "whitted", kd = 0.15, ks = 0.85, shininess = 300, color = [0.75, 0.78, 0.80])
  translate([1.9, 0.4, 0.9]) sphere(0.9);
material("die", model = "phong", kd = 0.8, ks = 0.2, color = [0.82, 0.20, 0.16])
  translate([0.1, 0.7, 0.52]) rotate([0, 0, 25]) difference() {
    intersection() {
      cube(1.04, center = true);
      sphere(0.74);
    }
    rotate([90, 0, 0]) cylinder(h = 2, r = 0.26, center = true);
  }
// Two pencils: 2.
material("pencil", model = "phong", kd = 0.85, ks = 0.15, color = [0.95, 0.75, 0.15])
  translate([1.3, -2.1, 0.08]) rotate([0, 90, 35]) cylinder(h = 2.2, r = 0.08);
material("pencil", model = "phong", kd = 0.85, ks = 0.15, color = [0.15, 0.45, 0.70])
  translate([-0.5, -2.2, 0.08]) rotate([0, 90, -20]) cylinder(h = 2.0, r = 0.08);

light(type = "point", position = [5, -6, 8], intensity = 0.95, color = [1, 0.95, 0.88]);
light(type = "point", position = [-6, -4, 6], intensity = 0.5, color = [0.88, 0.94, 1]);
ambient(0.5);
background([0.62, 0.72, 0.82]);
camera(from = [0.5, -8.0, 3.9], at = [0.1, -0.1, 0.7], fov = 40);
