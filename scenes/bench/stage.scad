// The stage that all scenes of the bench share, so that rates can be compared: one ground, two lights with hard shadows,
// one material, and a camera of 40 degrees.
include <tenon.scad>

module stage(ground, from, at) {
  material("solid", model = "phong", ka = 0.1, kd = 0.8, ks = 0.3, shininess = 40, color = [0.85, 0.55, 0.25]) children();
  material("ground", model = "phong", ka = 0.1, kd = 0.8, ks = 0, color = [0.60, 0.62, 0.60])
    translate([-30, -30, ground - 0.5]) cube([60, 60, 0.5]);
  light(type = "point", position = [8, -10, 14], intensity = 0.75);
  light(type = "point", position = [-12, -6, 9], intensity = 0.40);
  ambient([1, 1, 1]);
  background([0.55, 0.65, 0.80]);
  camera(from = from, at = at, fov = 40);
}
