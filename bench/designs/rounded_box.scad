// A box with round corners, inside and outside: 13 primitives.
module rounded_cube(x, y, z, r) {
  hull() for (a = [r, x - r]) for (b = [r, y - r]) translate([a, b, 0]) cylinder(r = r, h = z);
}
difference() {
  rounded_cube(90, 60, 25, 4);
  translate([2.5, 2.5, 2]) rounded_cube(85, 55, 40, 2.8);
  translate([45, -1, 14]) rotate([-90, 0, 0]) cylinder(r = 3.3, h = 6);
}
