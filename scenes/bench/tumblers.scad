// Tumblers of water with ice, bubbles and berries: media in media, which touch in faces.
include <stage.scad>

side = 6;

module glass() { material(model = "dielectric", ior = 1.5, priority = 3) children(); }
module water() { material(model = "dielectric", ior = 1.33, priority = 1) children(); }
module ice() { material(model = "dielectric", ior = 1.31, priority = 2) children(); }
module berry() { material(model = "principled", color = [0.8, 0.1, 0.12], roughness = 0.3, priority = 5) children(); }

module tumbler(turn) {
  glass() difference() {
    cylinder(h = 3, r = 1.4);
    translate([0, 0, 0.2]) cylinder(h = 3, r = 1.25);
  }
  water() difference() {
    translate([0, 0, 0.2]) cylinder(h = 2.2, r = 1.25);
    for (k = [0:7]) rotate([0, 0, 45 * k + turn]) translate([0.8, 0, 0.6 + 0.17 * k]) sphere(0.12);
  }
  ice() translate([0.2 * cos(5 * turn), 0.1, 2.1]) rotate([20 + turn, 30 + 2 * turn, 0]) cube(0.8, center = true);
  berry() translate([0.1, 0.2, 1]) sphere(0.35);
}

stage(-0.5, from = [0, -19, 13], at = [0, 0, 0.6])
  for (i = [0:side - 1], j = [0:side - 1])
    translate([3.2 * (i - (side - 1) / 2), 3.2 * (j - (side - 1) / 2), -0.5]) tumbler(10 * i + 7 * j);
