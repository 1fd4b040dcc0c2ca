#version 430 core
// Soft light from the camera's upper left, as in the pictures of the command line. Kept short:
// without a graphics card most of a frame's time is spent here.
flat in vec3 base;
in vec3 view_normal;

uniform float opacity;
uniform vec3 cut_face;  // inside surfaces behind a section, linear RGB

out vec4 colour;

// The sRGB curve by three square roots; off by less than two steps of 255.
vec3 to_srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  vec3 s = sqrt(c);
  vec3 r = sqrt(s);
  vec3 q = sqrt(r);
  return max(0.662002687 * s + 0.684122060 * r - 0.323583601 * q - 0.0225411470 * c, 0.0);
}

#ifdef HAS_FIELDS
flat in uint flags;
in float deviation;
in float knife_height;
uniform bool shows_deviation;
uniform int exact_pass;        // 1: only what is off by more than the tolerance, 2: a hint of the rest
uniform vec2 deviation_scale;  // tolerance, largest
uniform bool has_knife;
uniform vec3 accent;           // linear RGB

const uint kSelected = 2u;
const uint kHovered = 4u;
const uint kUnderKnife = 8u;
const uint kFaded = 16u;

// Blue inside, red outside, grey within the tolerance.
vec3 deviation_colour(float d) {
  if (abs(d) <= deviation_scale.x) return vec3(0.42);
  float range = max(deviation_scale.y - deviation_scale.x, 1e-30);
  float t = clamp((abs(d) - deviation_scale.x) / range, 0.0, 1.0);
  vec3 end = d > 0.0 ? vec3(0.72, 0.06, 0.07) : vec3(0.05, 0.18, 0.70);
  return mix(vec3(0.88), end, sqrt(t));
}

vec3 surface_colour() {
  vec3 c = base;
  if (shows_deviation) {
    c = deviation_colour(deviation);
    if ((flags & kSelected) != 0u) c = mix(c * 1.25, accent, 0.45);
    if ((flags & kHovered) != 0u) c = c * 1.12 + 0.04;
    if ((flags & kFaded) != 0u) c = mix(c, vec3(dot(c, vec3(0.3333))), 0.8) * 0.55;
  }
  if (has_knife && (flags & kUnderKnife) != 0u) {
    c = mix(c, knife_height > 0.0 ? vec3(0.85, 0.45, 0.10) : vec3(0.10, 0.45, 0.85), 0.55);
  }
  return c;
}
float alpha() {
  bool is_exact = abs(deviation) <= deviation_scale.x;
  if (exact_pass == (is_exact ? 1 : 2)) discard;
  return exact_pass == 2 ? 0.12 * opacity : opacity;
}
#else
vec3 surface_colour() { return base; }
float alpha() { return opacity; }
#endif

void main() {
  vec3 n = normalize(view_normal);
  if (n.z < 0.0) n = -n;  // two-sided when seen through
  const vec3 key = vec3(-0.426401, 0.639602, 0.639602);
  const vec3 fill = vec3(0.832050, 0.0, 0.554700);
  const vec3 half_way = vec3(-0.235469, 0.353202, 0.905434);  // between key and eye
  float wrapped = 0.5 + 0.5 * dot(n, key);
  float light = 0.16 + 0.78 * wrapped * wrapped + 0.16 * max(0.0, dot(n, fill)) +
                0.06 * max(0.0, n.y);
  float gloss = max(0.0, dot(n, half_way));
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;  // to the 32nd
  vec3 lit = surface_colour() * light + 0.10 * gloss;
  bool is_behind = !gl_FrontFacing && opacity >= 1.0;
  colour = vec4(to_srgb(is_behind ? cut_face : lit), alpha());
}
