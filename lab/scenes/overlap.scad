// 343 balls in a lattice, which overlap by this share of their diameter (0: they touch, 1: all in one place).
include <../../scenes/studio.scad>

overlap = 0;
side = 7;
step = 2 * (1 - overlap);
reach = step * (side - 1) / 2 + 1;

// The radii differ, so that no two balls are ever the same.
clay() for (i = [0 : side - 1], j = [0 : side - 1], k = [0 : side - 1])
  translate(step * [i - (side - 1) / 2, j - (side - 1) / 2, k - (side - 1) / 2])
    sphere(1 - 0.0005 * (i + side * j + side * side * k));
studio_lights();
camera(from = reach * [2.4, -4.2, 2.6], at = [0, 0, 0], fov = 44);
