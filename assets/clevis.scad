// A clevis: fork with rounded ears and a cross bore on a threaded-rod blank, whole part turned
// out of the axes.
$fn = 48;

rotate([20, 35, 0]) difference() {
  union() {
    translate([0, -10, -10]) cube([26, 20, 20]);
    translate([26, -10, 0]) rotate([-90, 0, 0]) cylinder(r = 10, h = 20);
    translate([-24, 0, 0]) rotate([0, 90, 0]) cylinder(r = 6, h = 25);
    translate([-26, 0, 0]) rotate([0, 90, 0]) cylinder(r1 = 4, r2 = 6, h = 2);
  }
  translate([8, -4, -11]) cube([40, 8, 22]);
  translate([26, -11, 0]) rotate([-90, 0, 0]) cylinder(r = 4, h = 22);
}
