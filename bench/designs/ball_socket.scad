// A ball socket with a slot: 7 primitives.
$fn = 72;
difference() {
  union() {
    cylinder(r = 18, h = 22);
    translate([0, 0, -6]) cylinder(r = 25, h = 6);
  }
  translate([0, 0, 18]) sphere(r = 14);
  for (a = [0, 120, 240]) rotate(a) translate([21.5, 0, -7]) cylinder(r = 2, h = 10, $fn = 32);
  translate([-2, -30, 10]) cube([4, 60, 20]);
}
