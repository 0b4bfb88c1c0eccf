// The small shell: 64 primitives.
include <stage.scad>
use <../small_shell.scad>

stage(ground = -1.05, from = [-3.5, -7, 5], at = [0.5, -0.7, -0.1]) small_shell();
