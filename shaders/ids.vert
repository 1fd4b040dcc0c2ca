#version 430 core
// Triangles of a part for picking: labels instead of looks.
layout(location = 0) in vec3 position;
layout(location = 2) in int label;

uniform mat4 view_projection;
uniform vec4 section;           // as in mesh.vert
uniform usamplerBuffer states;

flat out int face;
out gl_PerVertex { vec4 gl_Position; float gl_ClipDistance[1]; };

const uint kHidden = 1u;

void main() {
  face = label;
  gl_Position = view_projection * vec4(position, 1.0);
  gl_ClipDistance[0] = section.xyz == vec3(0.0) ? 1.0 : section.w - dot(section.xyz, position);
  bool is_hidden = label >= 0 && (texelFetch(states, label).a & kHidden) != 0u;
  if (is_hidden) gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
}
