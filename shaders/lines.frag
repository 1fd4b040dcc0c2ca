#version 430 core
flat in uint flags;
uniform vec4 plain;     // sRGB
uniform vec4 selected;  // sRGB
out vec4 colour;
const uint kSelected = 2u;
void main() { colour = (flags & kSelected) != 0u ? selected : plain; }
