// The grooved sphere: 7 primitives whose boxes all overlap.
include <stage.scad>
use <../grooved_sphere.scad>

stage(ground = -1.05, from = [2.6, -3.6, 2.2], at = [0, 0, 0]) grooved_sphere();
