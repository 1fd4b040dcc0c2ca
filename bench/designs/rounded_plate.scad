// A plate with round corners, holes and a slot: 12 primitives.
difference() {
  union() {
    translate([4, 0, 0]) cube([112, 60, 6]);
    translate([0, 4, 0]) cube([120, 52, 6]);
    for (x = [4, 116]) for (y = [4, 56]) translate([x, y, 0]) cylinder(r = 4, h = 6);
  }
  for (x = [10, 60, 110]) translate([x, 30, -1]) cylinder(r = 4.2, h = 10);
  translate([30, 30, -1]) cylinder(r = 3.5, h = 10);
  translate([30, 26.5, -1]) cube([20, 7, 10]);
  translate([50, 30, -1]) cylinder(r = 3.5, h = 10);
}
