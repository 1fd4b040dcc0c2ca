// A hook with two countersunk holes: 8 primitives.
difference() {
  union() {
    cube([30, 8, 60]);
    translate([0, 8, 8]) rotate([0, 90, 0]) cylinder(r = 8, h = 30);
    translate([0, 8, 0]) cube([30, 25, 6]);
    translate([0, 33, 0]) cube([30, 5, 16]);
  }
  for (z = [30, 50]) translate([15, -1, z]) rotate([-90, 0, 0]) cylinder(r = 2.2, h = 20);
  for (z = [30, 50]) translate([15, 5, z]) rotate([-90, 0, 0])
    cylinder(r1 = 2.2, r2 = 4.2, h = 3.01);
}
