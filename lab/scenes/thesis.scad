// The models of Zajíček's thesis on the bench's stage, as solids or as the meshes that stand for them:
// -D 'model="grooved_sphere"', "checkered_cube", "small_shell", "large_shell". -D 'mesh="FILE"' shows a mesh of it instead,
// -D bare=true the solid without ground and lights, -D segments=32 a shell of two turns, -D specular=true a mirror.
// The shells are unions of a segment and all the rest, as the thesis's loops make them.
include <../../scenes/bench/stage.scad>
use <../../scenes/grooved_sphere.scad>
use <../../scenes/checkered_cube.scad>
use <../../scenes/small_shell_lopsided.scad>
use <../../scenes/large_shell_lopsided.scad>

model = "grooved_sphere";
mesh = "";
local = "kd";
segments = 16;
bare = false;
specular = false;

module solid() {
  if (mesh != "") import(mesh, local = local);
  else if (model == "grooved_sphere") grooved_sphere();
  else if (model == "checkered_cube") checkered_cube();
  else if (model == "small_shell") lopsided_small_shell(segments);
  else if (model == "large_shell") lopsided_large_shell(65);
}
module finish() {
  if (specular) material("mirror", model = "whitted", kd = 0.1, ks = 0.9, shininess = 400, color = [0.9, 0.9, 0.9]) children();
  else children();
}

views = [
  ["grooved_sphere", -1.05, [2.6, -3.6, 2.2], [0, 0, 0]],
  ["checkered_cube", -1.15, [3.4, -5, 3.4], [0, 0, -0.05]],
  ["small_shell", -1.05, [-3.5, -7, 5], [0.5, -0.7, -0.1]],
  ["large_shell", -1.05, [4, -10, 8], [0.5, 0.4, -0.2]],
];

if (bare) solid();
else {
  v = views[search([model], views)[0]];
  stage(ground = v[1], from = v[2], at = v[3]) finish() solid();
}
