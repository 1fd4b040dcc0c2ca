// Soft light from the camera's upper left, as in the pictures of the command line.

// The sRGB curve by three square roots; off by less than two steps of 255.
vec3 to_srgb(vec3 c) {
  c = clamp(c, 0.0, 1.0);
  vec3 s = sqrt(c);
  vec3 r = sqrt(s);
  vec3 q = sqrt(r);
  return max(0.662002687 * s + 0.684122060 * r - 0.323583601 * q - 0.0225411470 * c, 0.0);
}

// Linear. `n`: unit, in view coordinates, towards the eye.
vec3 lit(vec3 base, vec3 n) {
  const vec3 key = vec3(-0.426401, 0.639602, 0.639602);
  const vec3 fill = vec3(0.832050, 0.0, 0.554700);
  const vec3 half_way = vec3(-0.235469, 0.353202, 0.905434);  // between key and eye
  float wrapped = 0.5 + 0.5 * dot(n, key);
  float light = 0.16 + 0.78 * wrapped * wrapped + 0.16 * max(0.0, dot(n, fill)) +
                0.06 * max(0.0, n.y);
  float gloss = max(0.0, dot(n, half_way));
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;
  gloss *= gloss;  // to the 32nd
  return base * light + 0.10 * gloss;
}
