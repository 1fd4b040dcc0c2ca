// A quarter-bend pipe elbow with a square and a round end.
$fn = 48;

module bend(radius) {
  rotate_extrude(angle = 90) translate([30, 0]) circle(r = radius);
}

difference() {
  union() {
    bend(12);
    translate([30, 0, 0]) rotate([90, 0, 0]) cylinder(r = 18, h = 5);
    translate([-5, 14, -16]) cube([5, 32, 32]);
  }
  bend(9);
  translate([30, 1, 0]) rotate([90, 0, 0]) cylinder(r = 9, h = 8);
  translate([-7, 30, 0]) rotate([0, 90, 0]) cylinder(r = 9, h = 8);
}
