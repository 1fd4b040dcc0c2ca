// A lever with a slot: 9 primitives.
difference() {
  union() {
    hull() {
      cylinder(r = 9, h = 6);
      translate([60, 0, 0]) cylinder(r = 6, h = 6);
    }
    cylinder(r = 9, h = 14);
  }
  translate([0, 0, -1]) cylinder(r = 4, h = 20);
  translate([60, 0, -1]) cylinder(r = 2.6, h = 20);
  translate([20, 0, 2]) hull() {
    cylinder(r = 3, h = 10);
    translate([25, 0, 0]) cylinder(r = 3, h = 10);
  }
}
