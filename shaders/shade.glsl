// How much a surface turns towards the eye; the same from both sides.
float facing(vec3 normal, vec3 towards_eye) {
  return clamp(abs(dot(normalize(normal), normalize(towards_eye))), 0.0, 1.0);
}

float headlight(vec3 normal, vec3 towards_eye) {
  return 0.12 + 0.88 * facing(normal, towards_eye);
}

// Bright where the surface turns away, a thin shaded veil where it faces the eye: the shape is
// read from its edges while what lies below stays visible.
float rim_light(vec3 normal, vec3 towards_eye) {
  float away = 1.0 - facing(normal, towards_eye);
  float edge = away * away;
  return 0.04 + 0.06 * (1.0 - away) + 2.6 * edge * edge;
}
