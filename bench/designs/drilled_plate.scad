// A plate with holes, a boss, a ball and a countersink: 12 primitives.
difference() {
  union() {
    cube([120, 60, 6]);
    translate([100, 30, 5]) cylinder(r = 8, h = 10);
    translate([20, 30, 5]) sphere(r = 4);
  }
  for (x = [10, 50, 90]) for (y = [8, 52]) translate([x, y, -1]) cylinder(r = 2.5, h = 10);
  translate([100, 30, -1]) cylinder(r = 4, h = 30);
  translate([60, 30, 3]) cylinder(r1 = 3, r2 = 6, h = 3.01);
  translate([60, 30, -1]) cylinder(r = 3, h = 10);
}
