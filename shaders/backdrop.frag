#version 430 core
in float height;
uniform vec3 top;
uniform vec3 bottom;
out vec4 colour;
void main() { colour = vec4(mix(bottom, top, clamp(height, 0.0, 1.0)), 1.0); }
