#version 430 core
// The solid of a tree, ray by ray: the ray's stretches inside every literal are cut by the tree's
// Boolean operations (Roth 1982). With HAS_IDS: which literal is where, for picking.
// Coordinates are those of the program: less its origin.
in vec2 screen;

uniform mat4 view;       // rigid, from the scene's coordinates
uniform mat4 projection;
uniform vec3 shift;      // of the program's origin from the scene's
uniform vec3 box_lo;     // around the solid
uniform vec3 box_hi;
uniform vec4 section;    // as in mesh.vert
uniform float same;      // crossings nearer to each other than this are one
uniform float pixel;     // model units, at the distance 1 or, in parallel views, at all
uniform isamplerBuffer shown;  // as which literal each flat end is shown: six a literal
uniform usamplerBuffer steps;  // literal, next when inside, next when outside
uniform uint start;
uniform usamplerBuffer states;

#ifdef HAS_IDS
layout(location = 0) out uint id;
#else
uniform float opacity;
uniform vec3 cut_face;  // linear RGB
uniform vec3 accent;    // linear RGB
layout(location = 0) out vec4 colour;
#include "light.glsl"
#include "looks.glsl"
#endif

#include "tree_solids.glsl"

const uint kSolid = 0xFFFFFFFEu;

uint inside[(STRETCHES + 31) / 32];  // a bit for each literal

void look_at(float t) {
  for (int w = 0; w < inside.length(); ++w) inside[w] = 0u;
  for (int s = 0; s < stretches; ++s) {
    if (enter[s] <= t && leave[s] > t) inside[owner[s] >> 5] |= 1u << (owner[s] & 31);
  }
}
bool is_solid() {
  uint at = start;
  while (at < kSolid) {
    uvec4 step = texelFetch(steps, int(at));
    bool is_in = (inside[step.x >> 5] >> (step.x & 31u) & 1u) != 0u;
    at = is_in ? step.y : step.z;
  }
  return at == kSolid;
}

// The literal without whose crossing the solid would not begin at `hit`; of coincident faces the
// first. Requires: the state just behind; a stretch.
int literal_at(float hit) {
  int first = -1;
  for (int s = 0; s < stretches; ++s) {
    bool is_near = abs(enter[s] - hit) <= same || abs(leave[s] - hit) <= same;
    if (!is_near) continue;
    if (first < 0) first = owner[s];
    uint bit = 1u << (owner[s] & 31);
    inside[owner[s] >> 5] ^= bit;
    bool matters = !is_solid();
    inside[owner[s] >> 5] ^= bit;
    if (matters) return owner[s];
  }
  return max(first, 0);
}

// Flush ends of several literals are shown as one of them.
int shown_as(int label, Solid s, vec3 normal) {
  int kind = int(s.shape.x);
  bool has_ends = kind == kBox || kind == kCylinder || kind == kPrism;
  if (!has_ends || (kind != kBox && normal.xy != vec2(0.0))) return label;
  int axis = normal.x != 0.0 ? 0 : normal.y != 0.0 ? 1 : 2;
  return texelFetch(shown, 6 * label + 2 * axis + (normal[axis] > 0.0 ? 1 : 0)).r;
}

struct Ray {
  vec3 origin, direction;
};

Ray ray_here() {
  mat3 to_scene = transpose(mat3(view));
  vec3 eye = -(to_scene * view[3].xyz) - shift;
  vec2 at = screen / vec2(projection[0][0], projection[1][1]);
  if (projection[3][3] == 0.0) return Ray(eye, normalize(to_scene * vec3(at, -1.0)));
  return Ray(eye + to_scene * vec3(at, 0.0), to_scene * vec3(0.0, 0.0, -1.0));
}

// Where the part of the ray begins that can be seen; `is_open`: on the section, or at the eye.
vec2 visible(Ray ray, out bool is_open) {
  vec2 t = slab(ray.origin.x, ray.direction.x, box_lo.x, box_hi.x);
  t = both(t, slab(ray.origin.y, ray.direction.y, box_lo.y, box_hi.y));
  t = both(t, slab(ray.origin.z, ray.direction.z, box_lo.z, box_hi.z));
  vec2 kept = vec2(projection[3][3] == 0.0 ? 0.0 : -kFar, kFar);
  if (section.xyz != vec3(0.0)) {
    float o = dot(section.xyz, ray.origin);
    kept = both(kept, below(o, dot(section.xyz, ray.direction), section.w));
  }
  is_open = kept.x > t.x;
  return both(t, kept);
}

// The first crossing behind which the solid lies; kFar: none.
float first_hit(float t, float end) {
  for (int i = 0; i < 2 * STRETCHES; ++i) {
    float next = kFar;
    for (int s = 0; s < stretches; ++s) {
      if (enter[s] > t) next = min(next, enter[s]);
      if (leave[s] > t) next = min(next, leave[s]);
    }
    if (next >= end) return kFar;
    t = next + same;
    look_at(t);
    if (is_solid()) return next;
  }
  return kFar;
}

// Steep faces are moved back, as triangles are by their polygon offset, so that lines at their rims
// stay in front.
void set_depth(Ray ray, float t, vec3 n, float from_eye) {
  float cosine = max(abs(dot(n, ray.direction)), 1e-3);
  float pixel_here = projection[3][3] == 0.0 ? pixel * from_eye : pixel;
  t += pixel_here * min(sqrt(1.0 - cosine * cosine) / cosine, 4.0);
  vec4 clip = projection * (view * vec4(ray.origin + t * ray.direction + shift, 1.0));
  gl_FragDepth = clamp(0.5 + 0.5 * clip.z / clip.w, 0.0, 1.0);
}

// What a ray meets first.
struct Hit {
  float t;  // kFar: nothing
  vec3 normal;
  int label;  // -1: the section
  bool is_on_rim;
};

Hit meet(Ray ray, float end, bool is_open) {
  Hit hit = Hit(kFar, -ray.direction, -1, false);
  stretches = 0;
  for (int l = 0; l < literal_count; ++l) add_literal(l, ray.origin, ray.direction);
  if (stretches == 0) return hit;
  look_at(0.0);
  if (is_open && is_solid()) {
    hit.t = 0.0;
    if (section.xyz != vec3(0.0)) hit.normal = section.xyz;
    return hit;
  }
  hit.t = first_hit(0.0, end);
  if (hit.t >= kFar) return hit;
  int label = literal_at(hit.t);
  Solid s = solid_at(label);
  vec3 p = to_local(s, ray.origin + hit.t * ray.direction);
  vec3 local = local_normal(s, p);
  vec3 n = normalize(local.x * s.row[0].xyz + local.y * s.row[1].xyz + local.z * s.row[2].xyz);
  hit.normal = dot(n, ray.direction) > 0.0 ? -n : n;
  hit.label = shown_as(label, s, local);
  hit.is_on_rim = is_on_rim(s, p, 2.0 * same);
  return hit;
}

void main() {
  Ray ray = ray_here();
  bool is_open;
  vec2 range = visible(ray, is_open);
  if (range.x >= range.y) discard;
  // Single precision is spent on the part itself, not on the way there.
  float way = range.x;
  ray.origin += way * ray.direction;
  // Where two literals touch, rounding may lead a ray between them to a face that no one sees. A ray
  // beside it does not get there: it is off every seam along an axis by more than the rims reach.
  vec3 beside = 16.0 * same * vec3(0.57, 0.31, 0.76);
  Hit hit = Hit(kFar, vec3(0.0), -1, true);
  for (int i = 0; i < 2 && hit.is_on_rim; ++i) {
    Hit next = meet(Ray(ray.origin + float(i) * beside, ray.direction), range.y - way, is_open);
    if (i > 0 && next.t >= kFar) break;
    hit = next;
  }
  if (hit.t >= kFar) discard;
  set_depth(ray, hit.t, hit.normal, way + hit.t);
#ifdef HAS_IDS
  id = uint(hit.label + 1);
#else
  vec3 seen = mat3(view) * hit.normal;
  vec3 c = cut_face;
  if (hit.label >= 0) {
    uvec4 state = texelFetch(states, hit.label);
    c = lit(with_flags(to_linear(vec3(state.rgb) / 255.0), state.a), seen);
  }
  colour = vec4(to_srgb(c), opacity);
#endif
}
