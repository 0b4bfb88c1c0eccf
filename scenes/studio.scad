// What the scenes of this folder share: a ground, a sky and two lights.
include <tenon.scad>

module ground(z, size = 30, tint = [0.80, 0.82, 0.83]) {
  material("ground", model = "phong", kd = 1, ks = 0, color = tint)
    translate([-size, -size, z - 0.5]) cube([2 * size, 2 * size, 0.5]);
}

module studio_lights() {
  light(type = "point", position = [8, -10, 14], intensity = 0.95, color = [1, 0.97, 0.92]);
  light(type = "point", position = [-12, -6, 9], intensity = 0.5, color = [0.9, 0.95, 1]);
  ambient(0.55);
  background([0.86, 0.90, 0.95]);
}

module clay(tint = [0.88, 0.55, 0.28]) {
  material("clay", model = "phong", kd = 0.8, ks = 0.2, shininess = 40, color = tint) children();
}
