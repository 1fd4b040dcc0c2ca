// Rods that end inside a hub, and an oblique oil hole that ends in its bore.
$fn = 32;
difference() {
  union() {
    cylinder(r = 15, h = 24);
    for (a = [20, 140, 260]) rotate([0, 0, a]) translate([10, 0, 12]) rotate([0, 83, 0]) cylinder(r1 = 4, r2 = 3, h = 30, $fn = 24);
    for (a = [20, 140, 260]) rotate([0, 0, a]) translate([39.7, 0, 15.6]) sphere(r = 5, $fn = 24);
  }
  translate([0, 0, -1]) cylinder(r = 7, h = 26);
  rotate([0, 0, 80]) translate([0, 0, 6]) rotate([0, 65, 0]) cylinder(r = 1.5, h = 30, $fn = 24);
}
