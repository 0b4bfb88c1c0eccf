// "The teapot in a stadium": Newell's teapot, 900 triangles or so, in the middle of a stadium of thousands of seats.
// -D seats=false leaves the teapot alone; -D wide=true looks from the stand in place of from beside the pot.
include <../../scenes/studio.scad>
use <../../scenes/newell.scad>

seats = true;
wide = false;

clay() for (t = newell_triangles(4, 4)) polygon3d(t);
if (seats) clay([0.4, 0.5, 0.7]) for (row = [0 : 19], i = [0 : 119])
  rotate([0, 0, 3 * i]) translate([400 + 12 * row, 0, 4 * row]) cube([6, 10, 5]);
// Alone it stands on a ground of its own size: the lawn is part of what makes the scene large.
reach = seats ? 800 : 8;
clay([0.55, 0.68, 0.45]) translate([-reach, -reach, -1]) cube([2 * reach, 2 * reach, 1]);

studio_lights();
camera(from = wide ? [500, -300, 130] : [3.2, -9.4, 5.0], at = wide ? [0, 0, 0] : [0.25, 0, 1.35], fov = 38);
