// Taubin's heart, a surface of degree 6: (x² + 9/4 y² + z² - 1)³ = x² z³ + 9/80 y² z³.
include <polynomials.scad>
include <studio.scad>

// How roots along a ray are isolated and refined; see README.md.
isolation = "interval";
refinement = "newton";

body = sum([square(X), scaled(9 / 4, square(Y)), square(Z), constant(-1)]);
lobes = times(sum([scaled(-1, square(X)), scaled(-9 / 80, square(Y))]), power(Z, 3));

material("enamel", model = "phong", kd = 0.78, ks = 0.22, shininess = 60, color = [0.80, 0.08, 0.12])
  algebraic(sum([power(body, 3), lobes]), [[-1.4, -0.9, -1.2], [1.4, 0.9, 1.5]], isolation, refinement);

ground(-1.03);
studio_lights();
camera(from = [1.6, -5.2, 1.5], at = [0, 0, 0.1], fov = 36);
