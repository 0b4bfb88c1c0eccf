// A bunny less another that stands a little aside: for `./dev bench bunny`.
local = "bvh";

difference() {
  import("../../build/bunny.off", local = local);
  translate([0.7, 0.3, -0.2]) import("../../build/bunny.off", local = local);
}
