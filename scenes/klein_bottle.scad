// Klein's bottle as a surface of degree 6, in the immersion that crosses itself along a circle; cut open.
//   (r² + 2 y - 1) ((r² - 2 y - 1)² - 8 z²) + 16 x z (r² - 2 y - 1) = 0,   r² = x² + y² + z²
include <polynomials.scad>
include <studio.scad>

upper = sum([R2, scaled(2, Y), constant(-1)]);
lower = sum([R2, scaled(-2, Y), constant(-1)]);
bottle = sum([times(upper, sum([square(lower), scaled(-8, square(Z))])), scaled(16, times(times(X, Z), lower))]);

material("glaze", model = "whitted", kd = 0.86, ks = 0.14, shininess = 90, color = [0.52, 0.30, 0.62])
  rotate([90, 0, 0]) difference() {
    algebraic(bottle, box = [[-4.4, -3.6, -2.6], [4.4, 3.6, 2.6]]);
    material("inside", model = "phong", kd = 0.9, ks = 0.1, shininess = 30, color = [0.93, 0.86, 0.66])
      translate([-5, -5, 0]) cube([10, 10, 5]);
  }

ground(-3.3);
studio_lights();
camera(from = [5.5, -12, 6], at = [0, 0, -0.2], fov = 38);
