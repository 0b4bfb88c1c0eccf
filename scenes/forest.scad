// A forest: 71,000 trees and stones of five kinds, each kind stored once.
n = 300;  // to a side
greens = ["#1f5f3a", "#2f7a3f", "#3f8f3a", "#5a9a3c"];

module tree(green) {
  color("#6b4423") cylinder(h = 0.5, r = 0.08);
  color(green)
    for (k = [0:3]) translate([0, 0, 0.35 + 0.25 * k]) cylinder(h = 0.4, r1 = 0.42 - 0.09 * k, r2 = 0);
}

// A ball with bites taken out of it; it shows what it was cut from.
module stone() {
  color("#8a8f99")
    difference() {
      scale([1, 1, 0.6]) sphere(0.25);
      translate([0.2, 0, 0.2]) sphere(0.15);
      translate([-0.2, 0.1, 0.2]) sphere(0.1);
    }
}

shift = rands(-0.35, 0.35, 2 * n * n, 7);
size = rands(0.7, 1.7, n * n, 8);
turn = rands(0, 360, n * n, 9);
kind = rands(0, 5, n * n, 10);

color("#a89a5b") translate([-1, -1, -0.5]) cube([n + 1, n + 1, 0.5]);
for (i = [0:n - 1], j = [0:n - 1]) let (k = i * n + j)
  // A clearing with a path to it.
  if (norm([i - 14, j - 16]) > 5 && abs(i - j + 2) > 1.5)
    translate([i + shift[2 * k], j + shift[2 * k + 1], 0]) rotate(turn[k]) scale(size[k])
      if (kind[k] > 4) stone(); else tree(greens[floor(kind[k])]);

// A lookout in the clearing.
translate([14, 16, 0]) {
  color("#c9b79c") difference() {
    union() {
      cylinder(h = 3.4, r1 = 0.9, r2 = 0.7);
      translate([0, 0, 3.4]) cylinder(h = 0.8, r = 1.1);
    }
    translate([0, 0, 3.8]) cylinder(h = 1, r = 0.9);
    for (a = [0:45:359]) rotate(a) translate([1, 0, 4.1]) cube([1, 0.35, 0.5], center = true);
    rotate(-130) translate([0, -0.3, -0.01]) cube([2, 0.6, 1.2]);
    for (a = [-100, -160]) rotate(a) translate([0.8, 0, 2.4]) rotate([0, 90, 0]) cylinder(h = 1, r = 0.18, center = true);
  }
}

light(type = "directional", direction = [1, 0.35, -0.75], color = "#ffe2b0", intensity = 0.9);
ambient("#5a6a80");
background("#cfe0ee");
camera(from = [0, -3, 8.5], at = [15, 17, 0.5], fov = 42);
