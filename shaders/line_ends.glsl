layout(set = 0, binding = 1) readonly buffer Data { vec4 data[]; };

const float kLeastRadius_px = 0.75;

// A segment of a line as it lies on the screen: x and y in pixels, then as in clip space.
struct Ends {
  vec4 a;
  vec4 b;
  float radius_a;
  float radius_b;
  vec2 along;  // of length 1
  bool shown;
};

vec4 to_pixels(vec4 clip) {
  return vec4((0.5 * clip.xy / clip.w + 0.5) * frame.target.xy, clip.z, clip.w);
}

float radius_at(float depth) {
  return max(0.5 * item.extra.x * frame.eyes[gl_ViewIndex].scale.y / depth, kLeastRadius_px);
}

Ends ends_of(uint segment) {
  Ends ends;
  mat4 clip_from_world = frame.eyes[gl_ViewIndex].clip_from_world;
  vec4 a = clip_from_world * vec4(data[item.ids.y + 2u * segment].xyz, 1);
  vec4 b = clip_from_world * vec4(data[item.ids.y + 2u * segment + 1u].xyz, 1);
  float near = frame.font.z;
  ends.shown = a.w >= near || b.w >= near;
  if (!ends.shown) return ends;
  // The part behind the eye can't be projected: it is cut off first.
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  ends.a = to_pixels(a);
  ends.b = to_pixels(b);
  ends.radius_a = radius_at(ends.a.w);
  ends.radius_b = radius_at(ends.b.w);
  ends.along = ends.b.xy - ends.a.xy;
  float span = length(ends.along);
  // Seen from its end, the nearer end's disc covers all the rest.
  if (span <= abs(ends.radius_a - ends.radius_b) || span < 1e-4) {
    if (ends.radius_a < ends.radius_b) {
      ends.a = ends.b;
      ends.radius_a = ends.radius_b;
    } else {
      ends.b = ends.a;
      ends.radius_b = ends.radius_a;
    }
    ends.along = vec2(1, 0);
  } else {
    ends.along /= span;
  }
  return ends;
}

