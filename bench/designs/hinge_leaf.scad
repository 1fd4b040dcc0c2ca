// A hinge leaf with countersunk holes: 11 primitives.
$fn = 48;
difference() {
  union() {
    translate([0, 0, -2]) cube([40, 60, 4]);
    for (y = [0, 24, 48]) translate([0, y, 0]) rotate([-90, 0, 0]) cylinder(r = 5, h = 12);
  }
  translate([0, -1, 0]) rotate([-90, 0, 0]) cylinder(r = 2.5, h = 70);
  for (y = [12, 36]) translate([-6, y, -6]) cube([12, 12, 12]);
  for (y = [10, 30, 50]) translate([28, y, -3]) cylinder(r = 2.2, h = 6);
  for (y = [10, 30, 50]) translate([28, y, 0]) cylinder(r1 = 2.2, r2 = 4.4, h = 2.2);
}
