// A slotted clamp with a screw and a nut trap: 7 primitives.
difference() {
  union() {
    cylinder(r = 14, h = 12);
    translate([0, -8, 0]) cube([26, 16, 12]);
  }
  translate([0, 0, -1]) cylinder(r = 10, h = 20);
  translate([0, -1, -1]) cube([40, 2, 20]);
  translate([20, -20, 6]) rotate([-90, 0, 0]) cylinder(r = 2.1, h = 40);
  translate([20, 5, 6]) rotate([-90, 0, 0]) cylinder(r = 3.9, h = 10);
  translate([20, -15, 6]) rotate([-90, 0, 0]) cylinder(r = 4.2, h = 10, $fn = 6);
}
