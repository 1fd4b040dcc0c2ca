// A spool with six holes: 10 primitives.
difference() {
  union() {
    cylinder(r = 25, h = 3);
    cylinder(r = 12, h = 25);
    translate([0, 0, 22]) cylinder(r = 25, h = 3);
  }
  translate([0, 0, -1]) cylinder(r = 4.5, h = 30);
  for (a = [0:60:300]) rotate(a) translate([18, 0, -1]) cylinder(r = 3.2, h = 40);
}
