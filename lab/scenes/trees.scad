// One solid by trees of different shape, and chains of operations of a given depth.
// -D 'shape="balanced"' or "lopsided": a union of `n` balls along a spiral, as a balanced tree or one ball and all the rest;
// -D 'shape="chain"' -D 'operation="union"', "difference" or "intersection": `n` balls, each operation's second operand being
// the whole rest.
include <../../scenes/studio.scad>

shape = "balanced";
operation = "union";
n = 64;

// Of differences a row of shells is left, each in the one before and a little out of it on the side that is seen; of
// intersections nothing would be left if balls lay in different places.
toward_eye = [3.4, -6.4, 4.2] / norm([3.4, -6.4, 4.2]);

module part(i) {
  if (shape == "chain" && operation == "difference") translate(2.2 * 1.02 * i / n * toward_eye) sphere(2.2 * (n - i) / n);
  else if (shape == "chain" && operation == "intersection") translate([0.3 * cos(137.5 * i), 0.3 * sin(137.5 * i), 0]) sphere(2 + 0.003 * i);
  else translate([2 * cos(137.5 * i) * sqrt(i / n), 2 * sin(137.5 * i) * sqrt(i / n), 0.4 * sin(40 * i)]) sphere(0.28 + 0.1 * (n - i) / n);
}
module balanced(first, end) {
  if (end - first == 1) part(first);
  else union() {
    balanced(first, floor((first + end) / 2));
    balanced(floor((first + end) / 2), end);
  }
}
module lopsided(first) {
  if (first == n - 1) part(first);
  else union() { part(first); lopsided(first + 1); }
}
module chain(first) {
  if (first == n - 1) part(first);
  else if (operation == "union") union() { part(first); chain(first + 1); }
  else if (operation == "difference") difference() { part(first); chain(first + 1); }
  else intersection() { part(first); chain(first + 1); }
}

clay() {
  if (shape == "balanced") balanced(0, n);
  if (shape == "lopsided") lopsided(0);
  if (shape == "chain") chain(0);
}
ground(-2.5);
studio_lights();
camera(from = [3.4, -6.4, 4.2], at = [0, 0, 0], fov = 40);
