// The scenes of Křivánek and Bubník's table 2, polygon by polygon, or what stands in for them with as many polygons:
// -D 'model="octagon"', "cylinder_100", "cylinder_10000", "teapot", "banana", "eagle", "small_triangles", "large_triangles".
// Those of the ART package are not at hand: banana and eagle are a bent tube and a bird-like blob of as many triangles, and
// all cameras and lights are ours. -D specular=true makes mirrors of all surfaces.
include <../../scenes/studio.scad>
use <../../scenes/bench/lehmer.scad>
use <../../scenes/newell.scad>
use <surfaces.scad>

model = "octagon";
specular = false;

module finish() {
  if (specular) material("mirror", model = "whitted", kd = 0.2, ks = 0.8, shininess = 200, color = [0.8, 0.82, 0.85]) children();
  else material("matte", model = "phong", kd = 1, ks = 0, color = [0.80, 0.62, 0.40]) children();
}
module polygons(list) { for (p = list) polygon3d(p); }

// A prism, sides of `rows` quadrilaterals each, lids as fans; an octagon's lids are one polygon each.
function ring(n, r, z) = [for (i = [0 : n - 1]) [r * cos(360 * i / n), r * sin(360 * i / n), z]];
function sides(n, rows, r, h) =
  let(p = [for (j = [0 : rows]) ring(n, r, h * j / rows)])
    [for (j = [0 : rows - 1], i = [0 : n - 1]) let(k = (i + 1) % n) [p[j][i], p[j][k], p[j + 1][k], p[j + 1][i]]];
function fan(n, r, z) = let(a = ring(n, r, z)) [for (i = [0 : n - 1]) [[0, 0, z], a[i], a[(i + 1) % n]]];

// n random triangles in a box, their corners up to `size` from a random place.
function random_triangles(n, size) =
  let(u = lehmer(2001, 12 * n))
    [for (i = [0 : n - 1])
       let(c = [for (a = [0 : 2]) 4 * u[12 * i + a] - 2])
         [for (k = [0 : 2]) [for (a = [0 : 2]) c[a] + size * (2 * u[12 * i + 3 + 3 * k + a] - 1)]]];

function banana(u, v) =
  let(s = 0.06 + 0.44 * pow(sin(180 * (0.02 + 0.96 * u)), 0.6), a = 130 * u - 65, r = 2)
    [(r + s * cos(360 * v)) * cos(a) - 1.4, s * sin(360 * v), (r + s * cos(360 * v)) * sin(a)];
function eagle(u, v) =
  let(t = 4 + 172 * u, w = 360 * v, wing = pow(abs(sin(w)), 12) * pow(sin(t), 4), beak = pow(max(0, cos(t)), 9),
      r = 0.8 + 0.15 * sin(3 * w) * sin(t) + 1.6 * wing + 0.5 * beak + 0.05 * sin(11 * w) * sin(7 * t))
    [r * sin(t) * cos(w) * 0.7, r * sin(t) * sin(w), r * cos(t) * 1.2];

finish() {
  if (model == "octagon") polygons(concat(sides(8, 1, 1.6, 2), [ring(8, 1.6, 0), ring(8, 1.6, 2)]));
  if (model == "cylinder_100") polygons(concat(sides(10, 8, 1.6, 2), fan(10, 1.6, 0), fan(10, 1.6, 2)));
  if (model == "cylinder_10000") polygons(concat(sides(100, 98, 1.6, 2), fan(100, 1.6, 0), fan(100, 1.6, 2)));
  if (model == "teapot") scale(0.75) polygons(split_triangles(newell_triangles(7, 8), 3751));
  if (model == "banana") translate([0, 0, 1]) polygons(split_triangles(tube_triangles(function(u, v) banana(u, v), 29, 78), 4586));
  if (model == "eagle") translate([0, 0, 1]) polygons(split_triangles(tube_triangles(function(u, v) eagle(u, v), 36, 64), 4684));
  if (model == "small_triangles") translate([0, 0, 1]) polygons(random_triangles(10000, 0.03));
  if (model == "large_triangles") translate([0, 0, 1]) polygons(random_triangles(10000, 0.5));
}

studio_lights();
camera(from = [3.4, -6.4, 4.2], at = [0, 0, 1], fov = 40);
