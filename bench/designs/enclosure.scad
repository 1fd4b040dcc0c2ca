// An enclosure with screw bosses: 21 primitives.
$fn = 40;
module rounded_cube(x, y, z, r) {
  hull() for (a = [r, x - r]) for (b = [r, y - r]) translate([a, b, 0]) cylinder(r = r, h = z);
}
difference() {
  union() {
    difference() {
      rounded_cube(80, 50, 30, 6);
      translate([3, 3, 3]) rounded_cube(74, 44, 40, 3);
    }
    for (x = [9, 71]) for (y = [9, 41]) translate([x, y, 1]) cylinder(r = 4, h = 25);
  }
  for (x = [9, 71]) for (y = [9, 41]) translate([x, y, 10]) cylinder(r = 1.5, h = 25);
  translate([30, -1, 10]) cube([20, 6, 10]);
}
