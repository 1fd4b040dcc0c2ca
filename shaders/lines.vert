#version 430 core
// Lines between faces.
layout(location = 0) in vec3 position;
layout(location = 1) in ivec2 labels;

uniform mat4 view_projection;
uniform vec4 section;
uniform float nearer;  // model units towards the eye, beside a hair's breadth
uniform usamplerBuffer states;

flat out uint flags;
out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };

const uint kHidden = 1u;

void main() {
  uint a = labels.x < 0 ? 0u : texelFetch(states, labels.x).a;
  uint b = labels.y < 0 ? 0u : texelFetch(states, labels.y).a;
  flags = (a | b) & ~kHidden;
  gl_Position = view_projection * vec4(position, 1.0);
  // In front of the faces that they border: the third row of the matrix is the depth per model unit.
  vec3 depth_axis = vec3(view_projection[0].z, view_projection[1].z, view_projection[2].z);
  vec3 w_axis = vec3(view_projection[0].w, view_projection[1].w, view_projection[2].w);
  float per_unit = length(depth_axis - w_axis * (gl_Position.z / gl_Position.w));
  gl_Position.z -= 1.5e-4 * gl_Position.w + nearer * per_unit;
  gl_ClipDistance[0] = section.xyz == vec3(0.0) ? 1.0 : section.w - dot(section.xyz, position);
  if ((a & b & kHidden) != 0u) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}
