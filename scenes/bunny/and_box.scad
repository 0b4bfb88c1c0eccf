// What of a bunny lies in a tilted box: for `./dev bench bunny`.
local = "bvh";

intersection() {
  import("../../build/bunny.off", local = local);
  translate([0, 0, 4]) rotate([20, 30, 40]) cube([6, 5, 7], center = true);
}
