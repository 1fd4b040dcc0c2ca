// A board mount with four standoffs: 10 primitives.
difference() {
  union() {
    cube([70, 50, 3]);
    for (x = [5, 65]) for (y = [5, 45]) translate([x, y, 2]) cylinder(r = 3.5, h = 8);
  }
  for (x = [5, 65]) for (y = [5, 45]) translate([x, y, 4]) cylinder(r = 1.4, h = 10);
  translate([15, 12, -1]) cube([40, 26, 10]);
}
