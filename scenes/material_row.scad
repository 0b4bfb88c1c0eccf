// The principled material: metallic from left to right, roughness from front to back; coats and glass behind.
//   tenon render scenes/material_row.scad --integrator path --spp 256 --size 1280x720
include <tenon.scad>

camera(from = [0, -19, 10], at = [0, 0.6, 0.4], fov = 33);
light(type = "sky", direction = [-0.4, 0.8, -0.9], turbidity = 2.5, intensity = 0.55);
light(type = "rectangle", position = [-9, -8, 12], direction = [0.6, 0.6, -0.8], size = [6, 6], intensity = 9);
background([0.2, 0.22, 0.26]);

// A ball with a window cut out of it, so that inner corners show too.
module sample() translate([0, 0, 1]) difference() {
  sphere(1);
  rotate([20, 0, 25]) translate([0.35, -1.1, 0.35]) cube(0.9);
}

material(model = "principled", color = [0.5, 0.5, 0.5], roughness = 0.6, texture = "checker",
         texture_color = [0.32, 0.32, 0.34], texture_size = 1.25)
  translate([-40, -40, -1]) cube([80, 80, 1]);

for (i = [0:5]) translate([2.5 * (i - 2.5), 0, 0]) {
  translate([0, -2.6, 0]) material(model = "principled", color = [0.86, 0.35, 0.2], roughness = i / 5) sample();
  material(model = "principled", color = [0.95, 0.68, 0.3], metallic = 1, roughness = i / 5) sample();
  translate([0, 2.6, 0]) material(model = "principled", color = [0.1, 0.3, 0.6], coat = i / 5, roughness = 0.7) sample();
  translate([0, 5.2, 0]) material(model = "principled", color = [0.9, 0.97, 0.95], transmission = 1, roughness = i / 7)
    sample();
}
