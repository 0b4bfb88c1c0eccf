// Solid textures: the pattern fills the solid, so that every cut shows what was inside.
//   tenon render scenes/stone_and_wood.scad --integrator path --spp 256 --size 1280x720
include <tenon.scad>

camera(from = [1, -15, 8.5], at = [0, 0, 1.5], fov = 46);
light(type = "sky", direction = [0.6, 0.8, -0.8], intensity = 0.6);
light(type = "sphere", position = [-10, -12, 16], radius = 2, color = [1, 0.95, 0.88], intensity = 38);
background([0.85, 0.87, 0.9]);

material(model = "lambert", color = [0.8, 0.8, 0.78]) translate([-50, -50, -1]) cube([100, 100, 1]);

// Half an egg of marble with a bore.
translate([-4.3, 0.3, 0])
  material(model = "principled", color = [0.93, 0.92, 0.9], texture = "marble", texture_color = [0.25, 0.27, 0.3],
           texture_size = 1.7, turbulence = 1.3, roughness = 0.25, coat = 0.6)
    difference() {
      translate([0, 0, 2.1]) scale([1, 1, 1.25]) sphere(2);
      translate([0, -3.3, 1.5]) rotate([0, 0, 25]) cube([5, 5, 5], center = true);
      translate([-0.4, 0, 2.3]) rotate([90, 0, 20]) cylinder(h = 6, r = 0.6, center = true);
    }

// A stool turned of one log.
translate([0.3, 0.8, 0])
  material(model = "principled", color = [0.78, 0.56, 0.33], texture = "wood", texture_color = [0.45, 0.26, 0.12],
           texture_size = 0.35, turbulence = 1.2, roughness = 0.5)
    translate([0, 0, 1.7]) difference() {
      rotate([90, 0, 70]) translate([0.5, 0.9, 0]) intersection() {
        cube([4.2, 3.4, 4.2], center = true);
        sphere(2.5);
      }
      translate([0, 0, 2.3]) sphere(1.7);
      rotate([0, 0, -20]) translate([0, 0, -0.9]) cube([1.3, 8, 1.8], center = true);
    }

// Granite by noise, and a checkered die.
translate([4.5, 1, 0])
  material(model = "principled", color = [0.72, 0.7, 0.69], texture = "noise", texture_color = [0.16, 0.15, 0.16],
           texture_size = 0.28, roughness = 0.35)
    difference() {
      cylinder(h = 3.2, r = 1.7);
      translate([0, 0, 0.5]) cylinder(h = 4, r1 = 0.9, r2 = 1.45);
      translate([0, -2.2, 2]) cube([1.1, 4, 3], center = true);
    }
translate([2.5, -3.4, 0.85]) rotate([0, 0, 30])
  material(model = "principled", color = "white", texture = "checker", texture_color = [0.55, 0.1, 0.1],
           texture_size = 0.4, roughness = 0.15)
    difference() {
      cube(1.7, center = true);
      translate([0.85, -0.85, 0.85]) sphere(0.95);
    }
