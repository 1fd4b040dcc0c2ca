// A ball knob with a collar, grip hollows around it and a blind D-shaped shaft hole.
$fn = 48;

difference() {
  union() {
    translate([0, 0, 22]) sphere(r = 14);
    cylinder(r = 8, h = 14);
    cylinder(r = 11, h = 3);
  }
  translate([0, 0, 33]) cylinder(r = 20, h = 10);
  for (i = [0:4]) rotate(72 * i) translate([17, 0, 22]) sphere(r = 6);
  difference() {
    translate([0, 0, -1]) cylinder(r = 4, h = 16);
    translate([2.5, -5, -2]) cube([5, 10, 20]);
  }
}
