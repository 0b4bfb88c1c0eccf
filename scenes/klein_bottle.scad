// Klein's bottle as a surface of degree 6, in the immersion that crosses itself along a circle:
//   f = (r² + 2 y - 1) ((r² - 2 y - 1)² - 8 z²) + 16 x z (r² - 2 y - 1) = 0,   r² = x² + y² + z²
// Here it has a wall, |f| <= wall, and is cut open.
include <polynomials.scad>
include <studio.scad>

wall = 0.4;

upper = sum([R2, scaled(2, Y), constant(-1)]);
lower = sum([R2, scaled(-2, Y), constant(-1)]);
bottle = sum([times(upper, sum([square(lower), scaled(-8, square(Z))])), scaled(16, times(times(X, Z), lower))]);

material("glaze", model = "phong", kd = 0.8, ks = 0.2, shininess = 60, color = [0.52, 0.30, 0.62])
  rotate([90, 0, 0]) difference() {
    algebraic(sum([bottle, constant(-wall)]), box = cube_of(5));
    algebraic(sum([bottle, constant(wall)]), box = cube_of(6));
    material("cut", model = "phong", kd = 0.9, ks = 0.1, shininess = 30, color = [0.93, 0.86, 0.66])
      translate([-6, 0, -6]) cube(12);
  }

ground(-3.5);
studio_lights();
camera(from = [5, -8.5, 10], at = [0, 0, -1], fov = 42);
