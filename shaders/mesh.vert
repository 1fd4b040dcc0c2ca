#version 430 core
// Triangles of a part, labelled by face group or literal. With HAS_FIELDS also their deviations and
// heights above the knife, which most pictures do without.
layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in int label;
layout(location = 3) in float value;

uniform mat4 view_projection;
uniform mat3 to_view;           // rotation of normals
uniform vec4 section;           // keeps section.xyz . p <= section.w; no section when xyz is zero
uniform usamplerBuffer states;  // per label: red, green, blue, flags
uniform vec3 accent;            // linear RGB

flat out vec3 base;  // linear RGB, with what the flags do to it
out vec3 view_normal;
#ifdef HAS_FIELDS
uniform vec4 knife;             // plane of the cut that is being placed
flat out uint flags;
out float deviation;
out float knife_height;
#endif
out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };

#include "looks.glsl"

void main() {
  uvec4 state = label < 0 ? uvec4(154u, 160u, 166u, 0u) : texelFetch(states, label);
  base = with_flags(to_linear(vec3(state.rgb) / 255.0), state.a);
  view_normal = to_view * normal;
#ifdef HAS_FIELDS
  flags = state.a;
  deviation = value;
  knife_height = dot(knife.xyz, position) - knife.w;
#endif
  gl_Position = view_projection * vec4(position, 1.0);
  gl_ClipDistance[0] = section.xyz == vec3(0.0) ? 1.0 : section.w - dot(section.xyz, position);
  if ((state.a & kHidden) != 0u) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);  // outside: no fragments
}
