// Pitched blades between a hub and a rim: their sides do not meet at right angles.
$fn = 36;
difference() {
  cylinder(r = 57, h = 16);
  translate([0, 0, -1]) cylinder(r = 55, h = 18);
}
cylinder(r = 18, h = 16);
intersection() {
  translate([0, 0, 1]) cylinder(r = 56, h = 14);
  for (i = [0 : 4]) rotate(72 * i) translate([12, 0, 8]) rotate([35, 0, 0]) translate([0, -14, -0.9]) cube([50, 28, 1.8]);
}
