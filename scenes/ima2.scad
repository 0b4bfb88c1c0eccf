// Made to IMA2 of Bouatouch et al. 1987 (RR-612, table 1): 72 spheres and cylinders, one light, ray tree of depth 1.
// Beads, each drilled through, on the line of a trefoil knot. `-D primitives=36` (24, 12, 8) gives the scenes of its
// table 4.
include <tenon.scad>

primitives = 72;
beads = primitives / 2;

function trefoil(a) = [sin(a) + 2 * sin(2 * a), cos(a) - 2 * cos(2 * a), -1.2 * sin(3 * a)];
function unit(v) = v / norm(v);

module along(direction) {
  polar = acos(direction.z);
  azimuth = atan2(direction.y, direction.x);
  rotate([0, polar, azimuth]) children();
}

for (i = [0 : beads - 1]) {
  a = 360 * i / beads;
  hue = 0.5 + 0.5 * sin(a);
  material("bead", model = "phong", kd = 0.75, ks = 0.25, shininess = 50,
           color = [0.90 - 0.65 * hue, 0.45 + 0.15 * hue, 0.25 + 0.50 * hue])
    translate(trefoil(a)) along(unit(trefoil(a + 1) - trefoil(a - 1))) difference() {
      sphere(0.38);
      cylinder(h = 1, r = 0.17, center = true);
    }
}

light(type = "point", position = [5, -8, 12], intensity = 0.85);
ambient(0.5);
background([0.93, 0.93, 0.90]);
camera(from = [2.5, -7.5, 8], at = [0, 0, 0], fov = 44);
