// A bearing housing with ribs: 9 primitives.
$fn = 64;
difference() {
  union() {
    translate([-45, -15, 0]) cube([90, 30, 8]);
    translate([0, 15, 35]) rotate([90, 0, 0]) cylinder(r = 25, h = 30);
    translate([-25, -15, 4]) cube([50, 30, 31]);
    for (s = [-1, 1]) scale([s, 1, 1]) translate([24, 3, 7]) rotate([90, 0, 0])
      linear_extrude(6) polygon([[0, 0], [18, 0], [0, 20]]);
  }
  translate([0, 20, 35]) rotate([90, 0, 0]) cylinder(r = 16, h = 50);
  translate([0, 20, 35]) rotate([90, 0, 0]) cylinder(r = 20, h = 12);
  for (x = [-38, 38]) translate([x, 0, -1]) cylinder(r = 4, h = 12);
}
