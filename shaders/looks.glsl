// What the flags of a label do to its colour; `accent` is the file's that includes this.

const uint kHidden = 1u;
const uint kSelected = 2u;
const uint kHovered = 4u;
const uint kFaded = 16u;

vec3 to_linear(vec3 c) {
  return mix(c / 12.92, pow((c + 0.055) / 1.055, vec3(2.4)), step(0.04045, c));
}

vec3 with_flags(vec3 c, uint bits) {
  if ((bits & kSelected) != 0u) c = mix(c * 1.25, accent, 0.45);
  if ((bits & kHovered) != 0u) c = c * 1.12 + 0.04;
  if ((bits & kFaded) != 0u) c = mix(c, vec3(dot(c, vec3(0.3333))), 0.8) * 0.55;
  return c;
}
