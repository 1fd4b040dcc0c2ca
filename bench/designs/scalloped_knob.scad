// A knob with round dents: 10 primitives.
$fn = 60;
difference() {
  union() {
    cylinder(r = 20, h = 12);
    translate([0, 0, -10]) cylinder(r = 9, h = 10);
  }
  for (a = [0:60:300]) rotate(a) translate([24, 0, -1]) cylinder(r = 7, h = 20);
  translate([0, 0, -11]) cylinder(r = 3, h = 16);
  translate([-10, -10, -4]) translate([0, 10+7, 0]) cube([20, 5, 4]);
}
