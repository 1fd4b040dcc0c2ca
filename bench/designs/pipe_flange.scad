// A pipe flange with six bolt holes: 10 primitives.
$fn = 72;
difference() {
  union() {
    cylinder(r = 50, h = 10);
    cylinder(r = 28, h = 13);
    translate([0, 0, -40]) cylinder(r = 24, h = 41);
  }
  translate([0, 0, -41]) cylinder(r = 20, h = 60);
  for (a = [0:60:300]) rotate(a) translate([39, 0, -1]) cylinder(r = 4.5, h = 20, $fn = 32);
}
