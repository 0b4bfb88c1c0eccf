// Stars as planar polygons of so many corners each, in rows: -D corners=8 -D 'method="snyder"' or "marchal".
include <../../scenes/studio.scad>

corners = 8;
method = "snyder";

function star(x, y, z, tilt) =
  [for (i = [0 : corners - 1])
     let(r = i % 2 == 0 || corners < 6 ? 0.48 : 0.3, a = 360 * i / corners)
       [x + r * cos(a), y + r * sin(a) * cos(tilt), z + r * sin(a) * sin(tilt)]];

clay() for (i = [0 : 19], j = [0 : 19]) polygon3d(star(i - 9.5, j - 9.5, 0.5, 9 * (i + j)), method = method);
ground(-0.2);
studio_lights();
camera(from = [0, -16, 13], at = [0, -1, 0], fov = 40);
