// A stepped shaft: taper, groove, chamfers, keyway and a centre bore.
$fn = 48;

difference() {
  rotate([0, 90, 0]) union() {
    cylinder(r1 = 7, r2 = 8, h = 1);
    translate([0, 0, 1]) cylinder(r = 8, h = 19);
    translate([0, 0, 20]) cylinder(r = 6.5, h = 2);
    translate([0, 0, 22]) cylinder(r = 12, h = 18);
    translate([0, 0, 40]) cylinder(r1 = 12, r2 = 9, h = 15);
    translate([0, 0, 55]) cylinder(r = 9, h = 24);
    translate([0, 0, 79]) cylinder(r1 = 9, r2 = 8, h = 1);
  }
  translate([58, -2.5, 5.5]) cube([14, 5, 5]);
  translate([-1, 0, 0]) rotate([0, 90, 0]) cylinder(r = 2.5, h = 13);
}
