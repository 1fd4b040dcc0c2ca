// A foot with a hidden screw hole: 4 primitives.
difference() {
  union() {
    cylinder(r1 = 12, r2 = 9, h = 14);
    translate([0, 0, 14]) cylinder(r = 4, h = 10);
  }
  translate([0, 0, -1]) cylinder(r = 2, h = 40);
  translate([0, 0, -1]) cylinder(r = 4.4, h = 8);
}
