// Cayley's cubic, within a sphere: 4 (x² + y² + z²) + 16 x y z = 1. It has four double points, as many as a surface of
// degree 3 can have.
include <polynomials.scad>
include <studio.scad>

// How roots along a ray are isolated and refined; see README.md.
isolation = "interval";
refinement = "newton";

cubic = sum([scaled(4, R2), scaled(16, times(X, times(Y, Z))), constant(-1)]);

material("porcelain", model = "whitted", kd = 0.86, ks = 0.14, shininess = 120, color = [0.22, 0.42, 0.70])
  rotate([0, 0, 12]) intersection() {
    algebraic(cubic, cube_of(1.3), isolation, refinement);
    material("cut", model = "phong", kd = 0.9, ks = 0.1, shininess = 30, color = [0.93, 0.90, 0.82]) sphere(1.25);
  }

ground(-1.0);
studio_lights();
camera(from = [2.9, -4.4, 2.6], at = [0, 0, 0], fov = 36);
