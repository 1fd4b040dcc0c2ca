#version 430 core
// Which face is where: label + 1; 0 is the background.
flat in int face;
layout(location = 0) out uint id;
void main() { id = uint(face + 1); }
