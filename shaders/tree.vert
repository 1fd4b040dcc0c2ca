#version 430 core
// One triangle over the whole picture, for a ray through every pixel.
out vec2 screen;  // [-1, 1], y upwards

void main() {
  screen = 2.0 * vec2((gl_VertexID << 1) & 2, gl_VertexID & 2) - 1.0;
  gl_Position = vec4(screen, 0.0, 1.0);
}
