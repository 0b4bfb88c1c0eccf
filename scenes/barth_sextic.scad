// Barth's sextic, within a sphere. Of its 65 double points, the most that a surface of degree 6 can have, 50 are here;
// the others lie at infinity. (W. Barth, Two projective surfaces with many nodes, 1996.)
include <polynomials.scad>
include <studio.scad>

golden = (1 + sqrt(5)) / 2;
function difference_of_squares(p, q) = sum([scaled(golden * golden, square(p)), scaled(-1, square(q))]);
planes = times(difference_of_squares(X, Y), times(difference_of_squares(Y, Z), difference_of_squares(Z, X)));
ball = square(sum([R2, constant(-1)]));

material("amber", model = "whitted", kd = 0.84, ks = 0.16, shininess = 100, color = [0.90, 0.58, 0.16])
  rotate([0, 0, 8]) intersection() {
    algebraic(sum([scaled(4, planes), scaled(-1 - 2 * golden, ball)]), box = cube_of(1.8));
    sphere(1.75);
  }

ground(-1.76);
studio_lights();
camera(from = [3.9, -6.4, 3.2], at = [0, 0, 0], fov = 36);
