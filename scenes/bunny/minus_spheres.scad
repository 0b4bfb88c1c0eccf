// A bunny that spheres have bitten: for `./dev bench bunny`.
local = "bvh";

difference() {
  import("../../build/bunny.off", local = local);
  for (i = [0 : 39]) translate([4.5 * sin(73 * i), 3.5 * cos(41 * i), 5 + 4.5 * sin(29 * i)]) sphere(0.5 + 0.02 * i);
}
