// A rim and a hub with tilted spokes between them, whose ends no face shows.
$fn = 40;
difference() {
  union() {
    difference() {
      cylinder(r = 50, h = 20);
      translate([0, 0, -1]) cylinder(r = 44, h = 22);
    }
    cylinder(r = 14, h = 20);
    for (i = [0 : 4]) rotate([0, 0, 72 * i]) translate([8, -4, 8]) rotate([0, 5, 0]) cube([39, 8, 6]);
  }
  translate([0, 0, -1]) cylinder(r = 6, h = 22);
}
