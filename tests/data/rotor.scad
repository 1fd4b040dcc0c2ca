// Five arms about a hub: none lies opposite to another, and all of them end in the hub.
$fn = 50;
difference() {
  union() {
    cylinder(r = 7, h = 8);
    for (i = [0:4]) rotate(72 * i) translate([0, -1.5, 1]) cube([22, 3, 6]);
  }
  translate([0, 0, -1]) cylinder(r = 3, h = 10);
}
