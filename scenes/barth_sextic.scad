// Barth's sextic, within a sphere. Of its 65 double points, the most that a surface of degree 6 can have, 50 are here;
// the others lie at infinity. (W. Barth, Two projective surfaces with many nodes, 1996.)
include <polynomials.scad>
include <studio.scad>

// How roots along a ray are isolated and refined; see README.md.
isolation = "interval";
refinement = "newton";

golden = (1 + sqrt(5)) / 2;
function difference_of_squares(p, q) = sum([scaled(golden * golden, square(p)), scaled(-1, square(q))]);
planes = times(difference_of_squares(X, Y), times(difference_of_squares(Y, Z), difference_of_squares(Z, X)));
ball = square(sum([R2, constant(-1)]));

material("amber", model = "phong", kd = 0.78, ks = 0.22, shininess = 60, color = [0.90, 0.56, 0.14])
  rotate([0, 0, 8]) intersection() {
    algebraic(sum([scaled(-4, planes), scaled(1 + 2 * golden, ball)]), cube_of(2.2), isolation, refinement);
    sphere(2.1);
  }

ground(-2.15);
studio_lights();
camera(from = [3.9, -6.6, 2.7], at = [0, 0, -0.05], fov = 40);
