// A clamping plate with slots at odd angles and a slanted edge: nothing lies on the axes' grid.
$fn = 48;

module slot(length, radius) {
  hull() {
    translate([-length / 2, 0, -1]) cylinder(r = radius, h = 12);
    translate([length / 2, 0, -1]) cylinder(r = radius, h = 12);
  }
}

difference() {
  cube([80, 50, 8]);
  translate([80, 28, -1]) rotate(35) translate([-20, 0, 0]) cube([60, 60, 10]);
  translate([22, 18, 0]) rotate(30) slot(20, 4);
  translate([22, 38, 0]) rotate(-20) slot(14, 3);
  translate([60, 14, 0]) rotate(75) slot(10, 3);
  translate([45, 32, 4]) cylinder(r = 7, h = 5);
  translate([45, 32, -1]) cylinder(r = 3, h = 10);
}
