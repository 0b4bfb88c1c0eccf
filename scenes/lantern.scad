// The puzzle ball around a lamp, for path tracing: light finds its way out through the holes.
include <tenon.scad>
use <demo.scad>

tints = [[0.93, 0.87, 0.76], [0.80, 0.25, 0.18], [0.93, 0.70, 0.25], [0.16, 0.55, 0.58]];
radii = [2.0, 1.64, 1.30, 0.98];

for (i = [0 : len(radii) - 1])
  material(str("carved", i), model = "principled", roughness = 0.35, color = tints[i])
    rotate([7 * i, -9 * i, 11 * i]) shell(radii[i], 0.17, 0.46);

// A stand of rings.
material("brass", model = "conductor", roughness = 0.3, color = [0.91, 0.72, 0.36]) {
  translate([0, 0, -1.78]) torus(R = 1.02, r = 0.11);
  translate([0, 0, -2.12]) torus(R = 1.35, r = 0.16);
}
material("floor", model = "principled", roughness = 0.25, color = [0.22, 0.25, 0.30])
  translate([-200, -200, -2.78]) cube([400, 400, 0.5]);

light(type = "sphere", position = [0, 0, 0], radius = 0.42, intensity = 9, color = [1, 0.78, 0.5]);
light(type = "rectangle", position = [7, -9, 10], direction = [-7, 9, -10], size = [8, 8],
      intensity = 8, color = [1, 0.96, 0.9]);
light(type = "environment", intensity = 0.5, color = [0.75, 0.85, 1]);
background([0.30, 0.34, 0.40]);
camera(from = [4.6, -7.6, 2.4], at = [0, 0, -0.35], fov = 40);
