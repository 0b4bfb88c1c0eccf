// The large shell: 195 spheres, nearly tangent to each other.
include <stage.scad>
use <../large_shell.scad>

stage(ground = -1.05, from = [4, -10, 8], at = [0.5, 0.4, -0.2]) large_shell();
