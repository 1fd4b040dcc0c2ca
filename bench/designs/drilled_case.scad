// A case with screw bosses and holes in its walls: 15 primitives.
difference() {
  cube([100, 70, 30]);
  translate([2, 2, 2]) cube([96, 66, 30]);
  for (i = [0:3]) translate([20+i*20, -1, 15]) rotate([-90, 0, 0]) cylinder(r = 3, h = 5);
  translate([-1, 35, 15]) rotate([0, 90, 0]) cylinder(r = 4, h = 5);
}
for (x = [8, 92]) for (y = [8, 62]) translate([x, y, 1]) difference() {
  cylinder(r = 4, h = 20);
  cylinder(r = 1.5, h = 30);
}
