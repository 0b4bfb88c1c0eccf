// The first scene of README.md.
difference() {
  cube([40, 30, 8]);
  for (x = [8, 32], y = [8, 22]) translate([x, y, 0]) cylinder(h = 8, r = 3);
  translate([20, 15, 4]) cylinder(h = 4, r1 = 4, r2 = 8);
}
