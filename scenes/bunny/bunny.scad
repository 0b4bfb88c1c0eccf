// The Stanford bunny (Figure 3.1 of Zajíček 2012). `./dev bunny` gets the mesh.
include <tenon.scad>

material("matte", kd = 0.9, ks = 0.1) color([0.85, 0.75, 0.65]) import("../../build/bunny.off");
material("matte") color([0.55, 0.58, 0.55]) translate([-200, -200, -1]) cube([400, 400, 1]);
light(type = "point", position = [12, -20, 25], intensity = 0.7);
light(type = "point", position = [-25, -15, 12], intensity = 0.25);
camera(from = [3, -27, 11], at = [0, 0, 4.6], fov = 32);
background([0.86, 0.9, 0.94]);
ambient([0.3, 0.33, 0.4]);
