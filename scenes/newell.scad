// Martin Newell's teapot (University of Utah, 1975), 28 bicubic Bézier patches, and the four of the bottom that were added
// later. The control points are those of the usual data set (S. J. Baker, "The history of the teapot", lists them); all rings
// have the same proportions but that of the knob, so that each is given by its radius and height here.
// A quarter of a ring, from +x to -y.
function ring(r, z, q) = let(c = is_undef(q) ? 0.56 * r : q) [[r, 0, z], [r, -c, z], [c, -r, z], [0, -r, z]];
function point(z) = [for (i = [0:3]) [0, 0, z]];
function mirrored(net, x, y) = [for (row = net) [for (p = row) [x * p.x, y * p.y, p.z]]];

quarters = [
  /* rim */    [ring(1.4, 2.4), ring(1.3375, 2.53125), ring(1.4375, 2.53125), ring(1.5, 2.4)],
  /* body */   [ring(1.5, 2.4), ring(1.75, 1.875), ring(2, 1.35), ring(2, 0.9)],
               [ring(2, 0.9), ring(2, 0.45), ring(1.5, 0.225), ring(1.5, 0.15)],
  /* bottom */ [ring(1.5, 0.15), ring(1.5, 0.075), ring(1.425, 0), point(0)],
  /* lid */    [point(3.15), ring(0.8, 3.15, 0.45), point(2.85), ring(0.2, 2.7)],
               [ring(0.2, 2.7), ring(0.4, 2.55), ring(1.3, 2.55), ring(1.3, 2.4)],
];

halves = [
  /* handle */
  [[[-1.6, 0, 2.025], [-1.6, -0.3, 2.025], [-1.5, -0.3, 2.25], [-1.5, 0, 2.25]],
   [[-2.3, 0, 2.025], [-2.3, -0.3, 2.025], [-2.5, -0.3, 2.25], [-2.5, 0, 2.25]],
   [[-2.7, 0, 2.025], [-2.7, -0.3, 2.025], [-3, -0.3, 2.25], [-3, 0, 2.25]],
   [[-2.7, 0, 1.8], [-2.7, -0.3, 1.8], [-3, -0.3, 1.8], [-3, 0, 1.8]]],
  [[[-2.7, 0, 1.8], [-2.7, -0.3, 1.8], [-3, -0.3, 1.8], [-3, 0, 1.8]],
   [[-2.7, 0, 1.575], [-2.7, -0.3, 1.575], [-3, -0.3, 1.35], [-3, 0, 1.35]],
   [[-2.5, 0, 1.125], [-2.5, -0.3, 1.125], [-2.65, -0.3, 0.9375], [-2.65, 0, 0.9375]],
   [[-2, 0, 0.9], [-2, -0.3, 0.9], [-1.9, -0.3, 0.6], [-1.9, 0, 0.6]]],
  /* spout */
  [[[1.7, 0, 1.425], [1.7, -0.66, 1.425], [1.7, -0.66, 0.6], [1.7, 0, 0.6]],
   [[2.6, 0, 1.425], [2.6, -0.66, 1.425], [3.1, -0.66, 0.825], [3.1, 0, 0.825]],
   [[2.3, 0, 2.1], [2.3, -0.25, 2.1], [2.4, -0.25, 2.025], [2.4, 0, 2.025]],
   [[2.7, 0, 2.4], [2.7, -0.25, 2.4], [3.3, -0.25, 2.4], [3.3, 0, 2.4]]],
  [[[2.7, 0, 2.4], [2.7, -0.25, 2.4], [3.3, -0.25, 2.4], [3.3, 0, 2.4]],
   [[2.8, 0, 2.475], [2.8, -0.25, 2.475], [3.525, -0.25, 2.49375], [3.525, 0, 2.49375]],
   [[2.9, 0, 2.475], [2.9, -0.15, 2.475], [3.45, -0.15, 2.5125], [3.45, 0, 2.5125]],
   [[2.8, 0, 2.4], [2.8, -0.15, 2.4], [3.2, -0.15, 2.4], [3.2, 0, 2.4]]],
];

function newell_nets() = concat(
  [for (net = quarters, x = [1, -1], y = [1, -1]) mirrored(net, x, y)],
  [for (net = halves, y = [1, -1]) mirrored(net, 1, y)]);

// Places on the patches, u and v in `steps` steps each way, as two triangles a square; those without area, at the top of
// the lid and under the bottom, are left out.
function blend(t) = let(s = 1 - t) [s * s * s, 3 * s * s * t, 3 * s * t * t, t * t * t];
function place(net, u, v) = let(a = blend(u), b = blend(v)) a * [for (row = net) b * row];
function newell_triangles(u_steps, v_steps) =
  [for (net = newell_nets())
     let(p = [for (i = [0 : u_steps]) [for (j = [0 : v_steps]) place(net, i / u_steps, j / v_steps)]])
       for (i = [0 : u_steps - 1], j = [0 : v_steps - 1],
            t = [[p[i][j], p[i + 1][j], p[i + 1][j + 1]], [p[i][j], p[i + 1][j + 1], p[i][j + 1]]])
         if (norm(cross(t[1] - t[0], t[2] - t[0])) > 1e-9) t];
