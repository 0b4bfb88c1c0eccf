// Steiner's Roman surface, of degree 4: x² y² + y² z² + z² x² = x y z. It crosses itself along the three axes.
include <polynomials.scad>
include <studio.scad>

// How roots along a ray are isolated and refined; see README.md.
isolation = "interval";
refinement = "newton";

roman = sum([times(square(X), square(Y)), times(square(Y), square(Z)), times(square(Z), square(X)),
             scaled(-1, times(X, times(Y, Z)))]);

material("celadon", model = "phong", kd = 0.8, ks = 0.2, shininess = 60, color = [0.30, 0.62, 0.56])
  rotate([0, 0, 20]) scale(2.4) algebraic(roman, cube_of(0.55), isolation, refinement);

ground(-0.92);
studio_lights();
camera(from = [2.6, -3.6, 2.6], at = [0, 0, -0.05], fov = 38);
