// Surfaces as lists of triangles.

// A surface f(u, v) closed around v, u and v from 0 to 1, its ends closed by fans: 2 around (rows + 1) triangles.
function tube_triangles(f, around, rows) =
  let(p = [for (j = [0 : rows + 1]) [for (i = [0 : around - 1]) f(j / (rows + 1), i / around)]])
    concat([for (j = [0 : rows], i = [0 : around - 1])
              let(k = (i + 1) % around) each [[p[j][i], p[j][k], p[j + 1][k]], [p[j][i], p[j + 1][k], p[j + 1][i]]]]);

// The same triangles, the first few cut in two, so that there are `count`.
function split_triangles(triangles, count) =
  let(cuts = count - len(triangles))
    assert(cuts >= 0 && cuts <= len(triangles), str(len(triangles), " triangles cannot become ", count))
    [for (i = [0 : len(triangles) - 1])
       let(t = triangles[i], m = (t[0] + t[1]) / 2) each i < cuts ? [[t[0], m, t[2]], [m, t[1], t[2]]] : [t]];
