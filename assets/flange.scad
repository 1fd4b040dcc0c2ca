// A pipe flange: raised face, tapered hub, bore and a circle of six bolt holes.
$fn = 60;

difference() {
  union() {
    cylinder(r = 40, h = 8);
    cylinder(r = 24, h = 10);
    translate([0, 0, -14]) cylinder(r1 = 17, r2 = 22, h = 14);
    translate([0, 0, -24]) cylinder(r = 17, h = 10);
  }
  translate([0, 0, -25]) cylinder(r = 13, h = 40);
  for (i = [0:5]) rotate(60 * i) translate([32, 0, -1]) cylinder(r = 3.5, h = 10);
}
