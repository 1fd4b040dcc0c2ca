// An arm between two eyes with a cross hole: 6 primitives.
difference() {
  union() {
    translate([0, -6, 0]) cube([80, 12, 8]);
    cylinder(r = 10, h = 12);
    translate([80, 0, 0]) cylinder(r = 7, h = 8);
  }
  translate([0, 0, -1]) cylinder(r = 4, h = 20);
  translate([80, 0, -1]) cylinder(r = 3.3, h = 20);
  translate([40, 0, 4]) rotate([90, 0, 0]) cylinder(r = 2.7, h = 30, center = true);
}
