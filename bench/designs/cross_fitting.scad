// A cross of pipes with flanges: 8 primitives.
$fn = 56;
difference() {
  union() {
    rotate([0, 90, 0]) cylinder(r = 12, h = 80, center = true);
    rotate([90, 0, 0]) cylinder(r = 12, h = 80, center = true);
    for (a = [0:90:270]) rotate(a) translate([34, 0, 0]) rotate([0, 90, 0]) cylinder(r = 15, h = 6);
  }
  rotate([0, 90, 0]) cylinder(r = 9, h = 90, center = true);
  rotate([90, 0, 0]) cylinder(r = 9, h = 90, center = true);
}
