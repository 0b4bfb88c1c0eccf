// Media in media: a tumbler of green-edged glass, water in it that touches the glass, ice in the water, a cherry in the
// ice. Solids of glass, water and ice share their faces; where they overlap the higher priority holds.
//   tenon render scenes/glass_and_water.scad --integrator path --spp 1024 --size 960x960
include <tenon.scad>

camera(from = [0, -17, 9], at = [0, 0, 3.3], fov = 34);
light(type = "sky", direction = [-0.9, 0.5, -0.75], turbidity = 3, intensity = 0.8);
light(type = "sphere", position = [14, -6, 16], radius = 2.2, color = [1, 0.93, 0.8], intensity = 42);
background([0.62, 0.7, 0.78]);

module glass() material(model = "dielectric", ior = 1.5, attenuation_color = [0.8, 0.95, 0.88], attenuation_distance = 3,
                        priority = 3) children();
module water() material(model = "dielectric", ior = 1.33, attenuation_color = [0.75, 0.92, 0.97],
                        attenuation_distance = 12, priority = 1) children();
module ice() material(model = "dielectric", ior = 1.31, priority = 2) children();

module cherry() {
  material(model = "principled", color = [0.72, 0.05, 0.08], roughness = 0.25, coat = 1, priority = 5)
    difference() {
      sphere(0.8);
      translate([0, 0, 1.05]) sphere(0.42);
    }
}

// The table: walnut with a hollow, where the wood goes on in the cut.
material(model = "principled", color = [0.62, 0.42, 0.26], texture = "wood", texture_color = [0.3, 0.17, 0.09],
         texture_size = 2.5, turbulence = 0.9, roughness = 0.45, priority = 9)
  translate([0, 0, -1]) rotate([90, 0, 14]) difference() {
    translate([-26, -2, -26]) cube([52, 3, 52]);
    translate([5.6, 2.4, 4.2]) sphere(2.2);
  }

// The tumbler.
glass() difference() {
  cylinder(h = 7, r1 = 2.5, r2 = 3);
  translate([0, 0, 0.8]) cylinder(h = 6.2, r1 = 2.25, r2 = 2.8);
}
// Water up to a little below the rim: exactly the hollow, so that it touches the glass.
water() intersection() {
  translate([0, 0, 0.8]) cylinder(h = 6.2, r1 = 2.25, r2 = 2.8);
  translate([-4, -4, 0]) cube([8, 8, 5.6]);
}
translate([-0.5, -0.3, 4.6]) rotate([24, 32, 18]) {
  ice() intersection() {
    cube(2.3, center = true);
    sphere(1.5);
  }
  cherry();
}
translate([1.05, 0.6, 2.2]) rotate([52, 8, 40]) ice() intersection() {
  cube(1.9, center = true);
  sphere(1.25);
}
translate([5.6, -4.2, 0.75]) cherry();
