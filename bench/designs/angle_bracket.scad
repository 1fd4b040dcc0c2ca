// An angle bracket with a rounded inner edge: 8 primitives.
difference() {
  union() {
    cube([60, 40, 5]);
    cube([60, 5, 40]);
    difference() {
      translate([0, 5, 5]) cube([60, 8, 8]);
      translate([-1, 13, 13]) rotate([0, 90, 0]) cylinder(r = 8, h = 70, $fn = 24);
    }
  }
  for (x = [15, 45]) {
    translate([x, 28, -1]) cylinder(r = 3.2, h = 10);
    translate([x, -1, 28]) rotate([-90, 0, 0]) cylinder(r = 3.2, h = 10);
  }
}
