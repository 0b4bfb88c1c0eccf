// A ball valve, half open. Look inside with: tenon render scenes/valve.scad --cut -y/x --hatch
include <tenon.scad>

bore = 12;      // radius of the way through
ball = 19;      // radius of the ball
reach = 52;     // from the middle to the end of a flange
turned = 35;    // how far the ball is turned, degrees

module along_x(h, r) rotate([0, 90, 0]) cylinder(h = h, r = r, center = true);

module flange() {
  difference() {
    rotate([0, 90, 0]) cylinder(h = 9, r = 34);
    for (a = [45 : 90 : 315]) rotate([a, 0, 0]) translate([0, 0, 26]) rotate([0, 90, 0]) cylinder(h = 9, r = 3.5);
  }
}

module body() {
  difference() {
    union() {
      along_x(2 * reach, 19);
      sphere(27);
      cylinder(h = 40, r = 13);
      for (side = [0, 180]) rotate(side) translate([reach - 9, 0, 0]) flange();
    }
    along_x(2 * reach, bore);
    intersection() { sphere(ball + 4); along_x(46, 19); }
    cylinder(h = 40, r = 4.5);
    translate([0, 0, 28]) cylinder(h = 12, r = 8);
  }
}

module seats() {
  difference() {
    along_x(46, 17);
    along_x(46, bore);
    sphere(ball);
  }
}

module valve_ball() {
  rotate(turned) difference() {
    sphere(ball);
    along_x(2 * ball, bore);
    translate([-20, -2, ball - 5]) cube([40, 4, 5]);
  }
}

module stem() {
  cylinder_from = ball - 1;
  translate([0, 0, cylinder_from]) cylinder(h = 50 - cylinder_from, r = 4.5);
  rotate(turned) translate([-4, -2, ball - 5]) cube([8, 4, 6]);
  translate([0, 0, 50]) cylinder(h = 6, r = 3);
}

module packing() {
  for (z = [28 : 4 : 32]) translate([0, 0, z]) difference() { cylinder(h = 4, r = 8); cylinder(h = 4, r = 4.5); }
}

module nut() {
  difference() {
    union() {
      translate([0, 0, 36]) cylinder(h = 6, r = 8);
      translate([0, 0, 40]) cylinder(h = 8, r = 14, $fn = 6);
    }
    translate([0, 0, 36]) cylinder(h = 12, r = 4.5);
  }
}

module handle() {
  rotate(turned) translate([0, 0, 50]) difference() {
    union() {
      cylinder(h = 4, r = 9);
      translate([-66, -6, 0]) cube([66, 12, 4]);
      translate([-66, 0, 0]) cylinder(h = 4, r = 6);
    }
    cylinder(h = 4, r = 3);
    translate([-62, 0, 0]) cylinder(h = 4, r = 2.5);
  }
}

module painted(tint, shininess = 40) material(model = "phong", kd = 0.8, ks = 0.2, shininess = shininess, color = tint) children();

painted([0.45, 0.55, 0.66]) body();
painted([0.90, 0.72, 0.33], 90) valve_ball();
painted([0.95, 0.95, 0.92]) seats();
painted([0.70, 0.71, 0.73], 90) stem();
painted([0.25, 0.25, 0.27]) packing();
painted([0.86, 0.62, 0.30], 90) nut();
painted([0.78, 0.16, 0.14]) handle();
