// A box less n spheres that take away the same volume together, whatever n: how speed depends on the number of primitives
// alone (-D n=100 to 1000000).
include <stage.scad>
use <lehmer.scad>

n = 1000;
// Together the spheres are as large as a third of the box; where they overlap, less is taken away.
volume = 8 / 3;
// Radii from half to one and a half times `mean`, evenly: the mean of their cubes is 1.25 mean^3.
mean = pow(volume / (n * 4 / 3 * PI * 1.25), 1 / 3);
u = lehmer(12345, 4 * n);

stage(ground = -1.05, from = [3, -4.4, 3], at = [0, 0, -0.05]) difference() {
  cube(2, center = true);
  for (i = [0 : n - 1])
    translate([2 * u[4 * i] - 1, 2 * u[4 * i + 1] - 1, 2 * u[4 * i + 2] - 1]) sphere(mean * (0.5 + u[4 * i + 3]));
}
