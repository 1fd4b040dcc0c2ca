// A fork end on a ball: 7 primitives.
$fn = 64;
difference() {
  union() {
    cylinder(r = 8, h = 30);
    translate([0, 0, 38]) sphere(r = 14);
    translate([-12, -14, 38]) cube([24, 28, 20]);
    translate([0, 0, 58]) rotate([0, 90, 0]) cylinder(r = 14, h = 24, center = true);
  }
  translate([-5, -20, 40]) cube([10, 40, 50]);
  translate([0, 0, 58]) rotate([0, 90, 0]) cylinder(r = 6, h = 50, center = true);
  translate([0, 0, -1]) cylinder(r = 4, h = 22);
}
