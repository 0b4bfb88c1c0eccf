// Newell's teapot as what it is: 32 bicubic Bézier patches.
include <studio.scad>
use <newell.scad>

// How a ray finds the patches; see README.md.
method = "interval";

material("glaze", model = "whitted", kd = 0.85, ks = 0.15, shininess = 120, color = [0.36, 0.55, 0.68]) bicubic(newell_nets(), method = method);

ground(0);
studio_lights();
camera(from = [3.2, -9.4, 5.0], at = [0.25, 0, 1.35], fov = 38);
