// A wheel with five spokes and a groove: 10 primitives.
$fn = 96;
difference() {
  union() {
    difference() {
      cylinder(r = 40, h = 12);
      translate([0, 0, -1]) cylinder(r = 33, h = 20);
    }
    cylinder(r = 10, h = 16);
    for (a = [0:72:288]) rotate(a) translate([8, -3, 2]) cube([27, 6, 8]);
  }
  translate([0, 0, -1]) cylinder(r = 5, h = 30);
  translate([0, 0, 6]) rotate_extrude() translate([40, 0]) circle(r = 3, $fn = 36);
}
