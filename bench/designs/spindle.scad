// A spindle with a keyway and a drilled end: 7 primitives.
$fn = 80;
difference() {
  union() {
    cylinder(r = 10, h = 30);
    translate([0, 0, 30]) cylinder(r = 16, h = 12);
    translate([0, 0, 42]) cylinder(r = 12, h = 40);
    translate([0, 0, 82]) cylinder(r1 = 12, r2 = 9, h = 3);
  }
  translate([-2.5, 7, 48]) cube([5, 10, 25]);
  translate([0, 0, -1]) cylinder(r = 4, h = 20);
  translate([0, 0, 19]) cylinder(r1 = 4, r2 = 0, h = 2.3);
}
