#version 430 core
// Kept short: without a graphics card most of a frame's time is spent here.
flat in vec3 base;
in vec3 view_normal;

uniform float opacity;
uniform vec3 cut_face;  // inside surfaces behind a section, linear RGB

out vec4 colour;

#include "light.glsl"

#ifdef HAS_FIELDS
flat in uint flags;
in float deviation;
in float knife_height;
uniform bool shows_deviation;
uniform int exact_pass;        // 1: only what is off by more than the tolerance, 2: a hint of the rest
uniform vec2 deviation_scale;  // tolerance, largest
uniform bool has_knife;
uniform vec3 accent;           // linear RGB

#include "looks.glsl"

const uint kUnderKnife = 8u;

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
  if (shows_deviation) c = with_flags(deviation_colour(deviation), flags);
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
  bool is_behind = !gl_FrontFacing && opacity >= 1.0;
  colour = vec4(to_srgb(is_behind ? cut_face : lit(surface_colour(), n)), alpha());
}
