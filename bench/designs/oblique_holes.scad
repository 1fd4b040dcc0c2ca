// A block with holes in three directions and a dent: 6 primitives.
difference() {
  cube([60, 40, 20]);
  translate([30, 20, 10]) rotate([0, 35, 0]) cylinder(r = 4, h = 60, center = true);
  translate([10, 20, 10]) rotate([90, 0, 0]) cylinder(r = 4.3, h = 60, center = true);
  translate([10, 20, -1]) cylinder(r = 3.8, h = 40);
  translate([50, 10, 20]) sphere(r = 4.2);
  translate([50, 30, 10]) cylinder(r = 4, h = 40);
}
