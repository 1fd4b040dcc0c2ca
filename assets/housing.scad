// An open housing: cavity, inner ribs, corner posts with pilot holes, a cable hole and vents.
$fn = 40;
outer = [70, 46, 26];
wall = 3;

difference() {
  cube(outer);
  difference() {
    translate([wall, wall, wall]) cube([64, 40, 30]);
    for (x = [23, 44]) translate([x, wall - 1, 0]) cube([3, 42, 12]);
    for (x = [7, 63], y = [7, 39]) translate([x, y, 0]) cylinder(r = 5, h = 22);
  }
  for (x = [7, 63], y = [7, 39]) translate([x, y, 8]) cylinder(r = 1.5, h = 20);
  translate([-1, 23, 16]) rotate([0, 90, 0]) cylinder(r = 5, h = 5);
  for (i = [0:3]) translate([28 + 4 * i, -1, 16]) cube([2, 5, 6]);
}
