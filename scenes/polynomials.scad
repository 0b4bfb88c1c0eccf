// Polynomials in x, y and z as algebraic() takes them: lists of terms [i, j, k, a] for a x^i y^j z^k. Equal terms may stand
// in a list more than once.
include <tenon.scad>

X = [[1, 0, 0, 1]];
Y = [[0, 1, 0, 1]];
Z = [[0, 0, 1, 1]];
function constant(a) = [[0, 0, 0, a]];
function sum(polynomials) = [for (p = polynomials) each p];
function times(p, q) = [for (s = p, t = q) [s[0] + t[0], s[1] + t[1], s[2] + t[2], s[3] * t[3]]];
function scaled(a, p) = [for (t = p) [t[0], t[1], t[2], a * t[3]]];
function power(p, n) = n == 0 ? constant(1) : times(p, power(p, n - 1));
function square(p) = times(p, p);

// x² + y² + z²
R2 = sum([square(X), square(Y), square(Z)]);

function cube_of(r) = [[-r, -r, -r], [r, r, r]];
