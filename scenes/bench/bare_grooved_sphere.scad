// The grooved sphere without ground: of its 7 primitives, whose boxes all overlap, how many does a ray have to be tested
// against (tenon render --stats -)?
include <tenon.scad>
use <../grooved_sphere.scad>

grooved_sphere();
light(type = "point", position = [8, -10, 14], intensity = 0.75);
camera(from = [2.6, -3.6, 2.2], at = [0, 0, 0], fov = 40);
