// How much a surface turns towards the eye; the same from both sides.
float facing(vec3 normal, vec3 towards_eye) {
  return clamp(abs(dot(normalize(normal), normalize(towards_eye))), 0.0, 1.0);
}

float headlight(vec3 normal, vec3 towards_eye) {
  return 0.12 + 0.88 * facing(normal, towards_eye);
}

// Whether a rim's light is its mean over the pixel: it falls off so fast that the light at the
// centre may be several times as much.
layout(constant_id = 1) const bool kMeanLight = true;

// How far from its value at the centre the cosine may reach within a pixel: on slivers of triangles
// at a silhouette its derivative is far too large.
const float kMostReach = 0.35;

// Five times the integral of (1 - |cosine|)^4 from 0.
float rim_up_to(float cosine) {
  float away = max(1.0 - abs(cosine), 0.0);
  float squared = away * away;
  return sign(cosine) * (1.0 - squared * squared * away);
}

// Bright where the surface turns away, a thin shaded veil where it faces the eye: the shape is
// read from its edges while what lies below stays visible.
float rim_light(vec3 normal, vec3 towards_eye) {
  float cosine = dot(normalize(normal), normalize(towards_eye));
  float away = max(1.0 - abs(cosine), 0.0);
  float edge = away * away * away * away;
  if (kMeanLight) {
    float reach = clamp(0.5 * fwidth(cosine), 1e-3, kMostReach);
    edge = (rim_up_to(cosine + reach) - rim_up_to(cosine - reach)) / (10.0 * reach);
  }
  return 0.04 + 0.06 * (1.0 - away) + 2.6 * edge;
}
