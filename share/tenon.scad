// Stand-ins for Tenon's own modules, so that a scene that says
//
//   include <tenon.scad>
//
// opens in OpenSCAD too (put this file's folder into OPENSCADPATH). Tenon does not read this file: its modules are built
// in, and exact. Here round solids have facets, and what is unbounded ends at a distance of tenon_far.

tenon_far = 1e4;

// A torus around z: R from the axis to the middle of the tube, r the tube's radius.
module torus(R = 1, r = 0.25) rotate_extrude() translate([R, 0]) circle(r);

// One sheet around z, from -h/2 to h/2, of radius `waist` at z = 0 and `r` at both ends.
module hyperboloid(h = 1, r = 1, waist = 0.5) {
  steps = 32;
  slope = (r * r - waist * waist) / (h * h / 4);
  profile = [for (i = [0:steps]) let(z = h * (i / steps - 0.5)) [sqrt(waist * waist + slope * z * z), z]];
  rotate_extrude() polygon(concat([[0, -h / 2]], profile, [[0, h / 2]]));
}

// Apex at the origin, opening along z, capped at z = h with radius r.
module paraboloid(h = 1, r = 1) {
  steps = 32;
  profile = [for (i = [1:steps]) let(s = i / steps) [r * s, h * s * s]];
  rotate_extrude() polygon(concat([[0, 0]], profile, [[0, h]]));
}

// Closed loops of corners [x, y] or [x, y, bulge]. Here an arc has 32 segments.
module tenon_outline(outline) {
  function arc(a, b, bulge) = let(
    w = [b[0] - a[0], b[1] - a[1]], k = (1 - bulge * bulge) / (4 * bulge),
    c = [(a[0] + b[0]) / 2 - k * w[1], (a[1] + b[1]) / 2 + k * w[0]], p = [a[0] - c[0], a[1] - c[1]], steps = 32
  ) [for (i = [0:steps - 1]) let(t = 4 * atan(bulge) * i / steps)
    [c[0] + p[0] * cos(t) - p[1] * sin(t), c[1] + p[0] * sin(t) + p[1] * cos(t)]];
  loops = [for (l = outline) [for (i = [0:len(l) - 1]) let(a = l[i], b = l[(i + 1) % len(l)])
    each (is_undef(a[2]) || a[2] == 0 ? [[a[0], a[1]]] : arc(a, b, a[2]))]];
  function first(n) = n == 0 ? 0 : first(n - 1) + len(loops[n - 1]);
  polygon([for (l = loops) each l], [for (i = [0:len(loops) - 1]) [for (j = [0:len(loops[i]) - 1]) first(i) + j]]);
}

// An outline swept along z.
module prism(outline, h = 1, center = false, scale = 1)
  linear_extrude(height = h, center = center, scale = scale) tenon_outline(outline);

// An outline swept along z while it turns and is scaled.
module twisted_prism(outline, h = 1, center = false, twist = 0, scale_x = 1, scale_y = 1)
  linear_extrude(height = h, center = center, twist = twist, scale = [scale_x, scale_y], slices = 100)
    tenon_outline(outline);

// An outline turned around z.
module revolution(outline) rotate_extrude() tenon_outline(outline);

// A sphere with a semi-axis for each of x, y and z.
module ellipsoid(r = [1, 1, 1]) scale(r) sphere(1);

// Between an ellipse at the origin and one at the end of the axis h, a height or a vector. Here it has 64 sides.
module truncated_cone(h = 1, a1 = 1, b1 = 0.5, a2 = 0.5, b2 = 1) {
  n = 64;
  top = is_num(h) ? [0, 0, h] : h;
  function ring(a, b, at) = [for (i = [0:n - 1]) at + [a * cos(360 * i / n), b * sin(360 * i / n), 0]];
  polyhedron(concat(ring(a1, b1, [0, 0, 0]), ring(a2, b2, top)), concat(
    [[for (i = [0:n - 1]) i]], [[for (i = [0:n - 1]) 2 * n - 1 - i]],
    [for (i = [0:n - 1], j = [(i + 1) % n]) each [[i, n + i, j], [j, n + i, n + j]]]));
}

// The solid of eight vertices: four around one face, and the four opposite to them.
module arb8(points)
  polyhedron(points, [[0, 1, 2, 3], [7, 6, 5, 4], [4, 5, 1, 0], [5, 6, 2, 1], [6, 7, 3, 2], [7, 4, 0, 3]]);

// OpenSCAD has nothing for surfaces that polynomials and patches describe, nor for surfaces without inside.
module tenon_missing(name) echo(str(name, "() is left out here; Tenon shows it"));
module quadric(coefficients, box) tenon_missing("quadric");
module algebraic(terms, box, isolation, refinement) tenon_missing("algebraic");
module polygon3d(points, normals, method) tenon_missing("polygon3d");
module bicubic(points, basis, bias, tension, method, size, steps, hull) tenon_missing("bicubic");

// The points p with normal * p <= d.
module halfspace(normal = [0, 0, 1], d = 0) {
  length = norm(normal);
  n = normal / length;
  rotate([0, acos(n.z), atan2(n.y, n.x)])
    translate([-tenon_far, -tenon_far, d / length - 2 * tenon_far]) cube(2 * tenon_far);
}

// The points within every plane [nx, ny, nz, d].
module convex_polyhedron(planes) {
  intersection_for (p = planes) halfspace([p[0], p[1], p[2]], p[3]);
}

// Everything outside the union of the children.
module complement() {
  difference() {
    cube(2 * tenon_far, center = true);
    children();
  }
}

module material(name, model, kd, ks, kt, ka, shininess, ior, color, priority, roughness, metallic, transmission, coat,
                coat_roughness, emission, attenuation_color, attenuation_distance, texture, texture_color,
                texture_size, turbulence) {
  if (is_undef(color)) children();
  else color(color) children();
}

// Whose material the faces of a cut show, "tool" or "base".
module cut_faces(show) children();

// What a section view takes away; here the scene stays whole.
module section(normal, d, planes) {}

module camera(from, at, up, fov, orthographic, aperture, fstop, focus) {}
module light(type, position, direction, angle, softness, color, intensity, fade_distance, radius, size, up,
             turbidity, turn, file, edges) {}
module background(color) {}
module ambient(color) {}
