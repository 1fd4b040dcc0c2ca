// The stretches of a ray inside each literal of a tree, exactly (but for the torus, whose ends are
// found by walking). As core/csg/tree_ray.cpp, with the numbers of core/csg/tree_program.h.

uniform samplerBuffer literals;  // four texels each: three rows to local coordinates, kind and shape
uniform int literal_count;

const float kFar = 1e30;
const int kBox = 0, kCylinder = 1, kPrism = 2, kSphere = 3, kTorus = 4;

// On the ray of this pixel.
float enter[STRETCHES];
float leave[STRETCHES];
int owner[STRETCHES];
int stretches = 0;

struct Solid {
  vec4 row[3];
  vec4 shape;
};

Solid solid_at(int l) {
  Solid s;
  for (int k = 0; k < 3; ++k) s.row[k] = texelFetch(literals, 4 * l + k);
  s.shape = texelFetch(literals, 4 * l + 3);
  return s;
}
vec3 to_local(Solid s, vec3 p) {
  vec4 q = vec4(p, 1.0);
  return vec3(dot(s.row[0], q), dot(s.row[1], q), dot(s.row[2], q));
}
vec3 direction_to_local(Solid s, vec3 d) {
  return vec3(dot(s.row[0].xyz, d), dot(s.row[1].xyz, d), dot(s.row[2].xyz, d));
}

void add(vec2 span, int l) {
  if (!(span.x < span.y) || span.y <= 0.0 || stretches >= STRETCHES) return;
  enter[stretches] = span.x;
  leave[stretches] = span.y;
  owner[stretches] = l;
  ++stretches;
}

const vec2 kAll = vec2(-kFar, kFar);
const vec2 kNothing = vec2(kFar, -kFar);

vec2 both(vec2 a, vec2 b) { return vec2(max(a.x, b.x), min(a.y, b.y)); }

// lo <= o + t d <= hi
vec2 slab(float o, float d, float lo, float hi) {
  if (d == 0.0) return o < lo || o > hi ? kNothing : kAll;
  float a = (lo - o) / d;
  float b = (hi - o) / d;
  return d > 0.0 ? vec2(a, b) : vec2(b, a);
}
vec2 below(float o, float d, float hi) {
  if (d == 0.0) return o > hi ? kNothing : kAll;
  float t = (hi - o) / d;
  return d > 0.0 ? vec2(-kFar, t) : vec2(t, kFar);
}

// Real roots of a t^2 + 2 b t + c, ascending; kNothing without two of them.
vec2 roots(float a, float b, float c) {
  float discriminant = b * b - a * c;
  if (!(discriminant > 0.0) || a == 0.0) return kNothing;
  float root = sqrt(discriminant);
  float q = -(b < 0.0 ? b - root : b + root);
  float x = q / a;
  float y = q == 0.0 ? 0.0 : c / q;
  return vec2(min(x, y), max(x, y));
}

// x^2 + y^2 <= (r + slope z)^2 within the slab where the radius is positive.
vec2 flank(vec3 o, vec3 d, float radius, float slope) {
  float r = radius + slope * o.z;
  float dr = slope * d.z;
  float a = dot(d.xy, d.xy) - dr * dr;
  float b = dot(o.xy, d.xy) - r * dr;
  float c = dot(o.xy, o.xy) - r * r;
  vec2 t = roots(a, b, c);
  if (t.x > t.y) {
    if (a == 0.0 && b != 0.0) return b > 0.0 ? vec2(-kFar, -c / (2.0 * b)) : vec2(-c / (2.0 * b), kFar);
    return c > 0.0 ? kNothing : kAll;
  }
  if (a > 0.0) return t;
  return dr > 0.0 ? vec2(t.y, kFar) : vec2(-kFar, t.x);
}

vec2 prism_side(float number, float sides) {
  float angle = 3.14159265359 * (2.0 * number + 1.0) / sides;
  return vec2(cos(angle), sin(angle));
}

float torus_distance(vec3 p, vec2 radii) {
  return length(vec2(length(p.xy) - radii.x, p.z)) - radii.y;
}

// Every end lies at least as far away as the surface does.
void add_torus(vec3 o, vec3 d, vec2 radii, int l) {
  float reach = radii.x + radii.y;
  vec2 range = roots(dot(d, d), dot(o, d), dot(o, o) - reach * reach);
  range = both(range, slab(o.z, d.z, -radii.y, radii.y));
  range.x = max(range.x, -1e-3 * reach);
  float smallest = 2e-5 * reach;
  float scale = 1.0 / length(d);
  bool is_inside = false;
  float from = range.x;
  float t = range.x;
  for (int i = 0; i < 256 && t < range.y; ++i) {
    float distance = torus_distance(o + t * d, radii);
    if ((distance < 0.0) != is_inside) {
      is_inside = !is_inside;
      if (is_inside) {
        from = t;
      } else {
        add(vec2(from, t), l);
      }
    }
    t += max(abs(distance), smallest) * scale;
  }
  if (is_inside) add(vec2(from, range.y), l);
}

void add_literal(int l, vec3 o, vec3 d) {
  Solid s = solid_at(l);
  vec3 p = to_local(s, o);
  vec3 v = direction_to_local(s, d);
  int kind = int(s.shape.x);
  if (kind == kBox) {
    vec2 t = slab(p.x, v.x, 0.0, s.shape.y);
    t = both(t, slab(p.y, v.y, 0.0, s.shape.z));
    add(both(t, slab(p.z, v.z, 0.0, s.shape.w)), l);
  } else if (kind == kCylinder) {
    float slope = (s.shape.z - s.shape.y) / s.shape.w;
    add(both(slab(p.z, v.z, 0.0, s.shape.w), flank(p, v, s.shape.y, slope)), l);
  } else if (kind == kPrism) {
    vec2 t = slab(p.z, v.z, 0.0, s.shape.z);
    for (float k = 0.0; k < s.shape.w; ++k) {
      vec2 n = prism_side(k, s.shape.w);
      t = both(t, below(dot(n, p.xy), dot(n, v.xy), s.shape.y));
    }
    add(t, l);
  } else if (kind == kSphere) {
    add(roots(dot(v, v), dot(p, v), dot(p, p) - s.shape.y * s.shape.y), l);
  } else if (kind == kTorus) {
    add_torus(p, v, s.shape.yz, l);
  }
}

// Whether two faces of the literal meet at a point on it.
bool is_on_rim(Solid s, vec3 p, float reach) {
  int kind = int(s.shape.x);
  if (kind == kBox) {
    vec3 beyond = abs(p - 0.5 * s.shape.yzw) - 0.5 * s.shape.yzw;
    float least = min(beyond.x, min(beyond.y, beyond.z));
    float most = max(beyond.x, max(beyond.y, beyond.z));
    return beyond.x + beyond.y + beyond.z - least - most > -reach;
  }
  if (kind != kCylinder && kind != kPrism) return false;
  bool is_cylinder = kind == kCylinder;
  float height = is_cylinder ? s.shape.w : s.shape.z;
  if (max(-p.z, p.z - height) < -reach) return false;
  float slope = is_cylinder ? (s.shape.z - s.shape.y) / s.shape.w : 0.0;
  return length(p.xy) - s.shape.y - slope * p.z > -reach;
}

// Of the literal's boundary near a point on it, local coordinates; not unit.
vec3 local_normal(Solid s, vec3 p) {
  int kind = int(s.shape.x);
  if (kind == kBox) {
    vec3 q = p - 0.5 * s.shape.yzw;
    vec3 beyond = abs(q) - 0.5 * s.shape.yzw;
    if (beyond.x >= max(beyond.y, beyond.z)) return vec3(sign(q.x), 0.0, 0.0);
    return beyond.y >= beyond.z ? vec3(0.0, sign(q.y), 0.0) : vec3(0.0, 0.0, sign(q.z));
  }
  if (kind == kSphere) return p;
  float across = length(p.xy);
  if (kind == kTorus) return p - vec3(p.xy * (s.shape.y / across), 0.0);
  bool is_cylinder = kind == kCylinder;
  float height = is_cylinder ? s.shape.w : s.shape.z;
  float end = max(-p.z, p.z - height);
  if (is_cylinder) {
    float slope = (s.shape.z - s.shape.y) / s.shape.w;
    float beyond = (across - s.shape.y - slope * p.z) * inversesqrt(1.0 + slope * slope);
    if (beyond >= end) return vec3(p.xy, -slope * across);
  } else {
    float number = floor(atan(p.y, p.x) * s.shape.w / 6.28318530718);
    vec2 n = prism_side(number, s.shape.w);
    if (dot(n, p.xy) - s.shape.y >= end) return vec3(n, 0.0);
  }
  return vec3(0.0, 0.0, p.z > 0.5 * height ? 1.0 : -1.0);
}
