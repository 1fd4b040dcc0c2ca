#version 430 core
// Soft light from the camera's upper left, as in the pictures of the command line.
flat in uvec4 state;
flat in int face;
in vec3 view_normal;
in float deviation;
in float knife_height;

uniform float opacity;
uniform vec3 accent;           // linear RGB
uniform vec3 cut_face;         // inside surfaces behind a section, linear RGB
uniform bool shows_deviation;
uniform vec2 deviation_scale;  // tolerance, largest
uniform bool has_knife;

out vec4 colour;

const uint kSelected = 2u;
const uint kHovered = 4u;
const uint kUnderKnife = 8u;
const uint kFaded = 16u;

vec3 to_linear(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}
vec3 to_srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  return mix(12.92 * c, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, c));
}

// Blue inside, red outside, grey within the tolerance.
vec3 deviation_colour(float d) {
  if (abs(d) <= deviation_scale.x) return vec3(0.42);
  float range = max(deviation_scale.y - deviation_scale.x, 1e-30);
  float t = clamp((abs(d) - deviation_scale.x) / range, 0.0, 1.0);
  vec3 end = d > 0.0 ? vec3(0.72, 0.06, 0.07) : vec3(0.05, 0.18, 0.70);
  return mix(vec3(0.88), end, sqrt(t));
}

void main() {
  if (!gl_FrontFacing && opacity >= 1.0) {
    colour = vec4(to_srgb(cut_face), 1.0);
    return;
  }
  vec3 base = shows_deviation ? deviation_colour(deviation) : to_linear(vec3(state.rgb) / 255.0);
  if ((state.a & kSelected) != 0u) base = mix(base * 1.25, accent, 0.45);
  if ((state.a & kHovered) != 0u) base = base * 1.12 + 0.04;
  if ((state.a & kFaded) != 0u) base = mix(base, vec3(dot(base, vec3(0.3333))), 0.8) * 0.55;
  if (has_knife && (state.a & kUnderKnife) != 0u) {
    base = mix(base, knife_height > 0.0 ? vec3(0.85, 0.45, 0.10) : vec3(0.10, 0.45, 0.85), 0.55);
  }
  vec3 n = normalize(view_normal);
  if (n.z < 0.0) n = -n;  // two-sided when seen through
  vec3 key = normalize(vec3(-0.5, 0.75, 0.75));
  vec3 fill = normalize(vec3(0.9, 0.0, 0.6));
  float wrapped = 0.5 + 0.5 * dot(n, key);
  float light = 0.16 + 0.78 * wrapped * wrapped + 0.16 * max(0.0, dot(n, fill)) +
                0.06 * max(0.0, n.y);
  vec3 half_way = normalize(key + vec3(0.0, 0.0, 1.0));
  float gloss = 0.10 * pow(max(0.0, dot(n, half_way)), 40.0);
  colour = vec4(to_srgb(base * light + gloss), opacity);
}
