// The box of Goral et al. (1984) as Cornell measured it, in metres: white walls, red left, green right, a lamp in the
// ceiling. Made for path tracing: tenon render scenes/cornell_box.scad --integrator path --spp 256 --size 512x512
include <tenon.scad>

camera(from = [2.78, -8, 2.73], at = [2.78, 0, 2.73], fov = 39.3);
light(type = "rectangle", position = [2.78, 2.795, 5.48], direction = [0, 0, -1], size = [1.3, 1.05],
      color = [1, 0.85, 0.62], intensity = 17);
ambient(0);
background([0, 0, 0]);

white = [0.87, 0.86, 0.84];
wall = 0.1;

module room() {
  color(white) {
    translate([0, 0, -wall]) cube([5.5, 5.6, wall]);
    translate([0, 0, 5.48]) cube([5.5, 5.6, wall]);
    translate([0, 5.6, -wall]) cube([5.5, wall, 5.48 + 2 * wall]);
  }
  color([0.79, 0.24, 0.2]) translate([-wall, 0, -wall]) cube([wall, 5.6 + wall, 5.48 + 2 * wall]);
  color([0.31, 0.62, 0.27]) translate([5.5, 0, -wall]) cube([wall, 5.6 + wall, 5.48 + 2 * wall]);
}

material(model = "lambert") room();
// What a CSG tracer has in place of two boxes: a block with a hollow, and a lens-like ball of glass on it.
translate([1.85, 1.7, 0]) rotate([0, 0, -17]) {
  material(model = "lambert", color = white) difference() {
    translate([-0.83, -0.83, 0]) cube([1.66, 1.66, 1.65]);
    translate([0, 0, 1.65]) sphere(0.55);
  }
  translate([0, 0, 1.65]) material(model = "dielectric", ior = 1.5) sphere(0.5);
}
translate([3.7, 3.5, 0]) rotate([0, 0, 17]) material(model = "conductor", color = [0.95, 0.93, 0.88], roughness = 0.2)
  difference() {
    translate([-0.83, -0.83, 0]) cube([1.66, 1.66, 3.3]);
    translate([0, 0, 2.3]) rotate([90, 0, 0]) cylinder(h = 4, r = 0.5, center = true);
  }
