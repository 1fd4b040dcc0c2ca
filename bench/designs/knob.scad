// A knob with a ball end and a hexagon socket: 5 primitives.
difference() {
  union() {
    cylinder(r = 15, h = 10);
    translate([0, 0, 10]) cylinder(r1 = 12, r2 = 9, h = 15);
    translate([0, 0, 25]) sphere(r = 9);
  }
  translate([0, 0, -1]) cylinder(r = 3, h = 20);
  translate([0, 0, -1]) cylinder(r = 5.6, h = 6, $fn = 6);
}
