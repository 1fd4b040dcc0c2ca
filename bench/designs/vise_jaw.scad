// A vise jaw with grooves and two counterbored holes: 7 primitives.
difference() {
  cube([80, 20, 30]);
  for (x = [20, 60]) translate([x, -1, 15]) rotate([-90, 0, 0]) cylinder(r = 4, h = 30);
  for (x = [20, 60]) translate([x, -1, 15]) rotate([-90, 0, 0]) cylinder(r = 7.5, h = 6);
  translate([40, 20, -1]) rotate([0, 0, 45]) translate([-5, -5, 0]) cube([10, 10, 40]);
  translate([-1, 20, 15]) rotate([45, 0, 0]) translate([0, -3, -3]) cube([90, 6, 6]);
}
