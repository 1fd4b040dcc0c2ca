// An angle bracket: two legs, a fillet between them, rounded ends, countersunk holes.
$fn = 48;
width = 30;
thickness = 5;

module leg_with_hole(length) {
  difference() {
    hull() {
      cube([1, width, thickness]);
      translate([length - 6, 6, 0]) cylinder(r = 6, h = thickness);
      translate([length - 6, width - 6, 0]) cylinder(r = 6, h = thickness);
    }
    translate([length - 12, width / 2, -1]) cylinder(r = 3, h = thickness + 2);
    translate([length - 12, width / 2, thickness - 2.5]) cylinder(r1 = 3, r2 = 5.5, h = 2.5);
    translate([length - 12, width / 2, thickness]) cylinder(r = 5.5, h = 1);
  }
}

module fillet(radius) {
  difference() {
    cube([radius, width, radius]);
    translate([radius, -1, radius]) rotate([-90, 0, 0]) cylinder(r = radius, h = width + 2);
  }
}

leg_with_hole(45);
translate([0, width, 0]) rotate([0, -90, 180]) leg_with_hole(35);
translate([thickness, 0, thickness]) fillet(8);
