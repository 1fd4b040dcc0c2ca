// A nozzle with a bend: a cone joins a pipe in a ball, so that next to no corner of the cone's
// facets lies on the cone, and few of the ball's on the ball.
$fn = 36;
module spout(r0, r1, l) rotate([0, 30, 0]) cylinder(r1 = r0, r2 = r1, h = l);
difference() {
  union() {
    translate([0, 0, -20]) cylinder(r = 11, h = 20);
    sphere(r = 11);
    spout(11, 5, 42);
  }
  translate([0, 0, -21]) cylinder(r = 8, h = 21);
  sphere(r = 8);
  spout(8, 3, 43);
}
