// A pulley with a grub screw hole: 6 primitives.
difference() {
  union() {
    cylinder(r = 11, h = 2);
    translate([0, 0, 2]) cylinder(r = 8, h = 7);
    translate([0, 0, 9]) cylinder(r = 11, h = 2);
    translate([0, 0, 11]) cylinder(r = 7, h = 8);
  }
  translate([0, 0, -1]) cylinder(r = 2.5, h = 30);
  translate([0, 0, 15]) rotate([90, 0, 0]) cylinder(r = 1.6, h = 20);
}
