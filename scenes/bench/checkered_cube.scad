// The checkered cube: 151 boxes, which a mesh of few triangles represents exactly.
include <stage.scad>
use <../checkered_cube.scad>

stage(ground = -1.15, from = [3.4, -5, 3.4], at = [0, 0, -0.05]) checkered_cube();
