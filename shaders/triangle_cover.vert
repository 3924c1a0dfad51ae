#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "coverage.glsl"

layout(set = 0, binding = 1) readonly buffer Data { vec4 data[]; };

// For each side: its inward normal, and the distance of the image's corner from it, in pixels.
layout(location = 0) flat out vec3 side_a;
layout(location = 1) flat out vec3 side_b;
layout(location = 2) flat out vec3 side_c;

const float kLongest_px = 3.0;

vec4 clip_of(uint corner) {
  return frame.eyes[gl_ViewIndex].clip_from_world * vec4(data[item.ids.y + corner].xyz, 1);
}

vec2 pixels_of(vec4 clip) { return (0.5 * clip.xy / clip.w + 0.5) * frame.target.xy; }

vec3 side(vec2 from, vec2 to, float turn) {
  vec2 along = to - from;
  vec2 normal = turn * vec2(-along.y, along.x) / max(length(along), 1e-6);
  return vec3(normal, -dot(normal, from));
}

void main() {
  vec4 clip[3] = vec4[](clip_of(0u), clip_of(1u), clip_of(2u));
  uint corner = uint(gl_VertexIndex) % 3u;
  gl_Position = clip[corner];
  side_a = side_b = side_c = vec3(0, 0, 1e3);
  // A triangle that reaches behind the eye is clipped by the device and has other corners than
  // these.
  if (min(min(clip[0].w, clip[1].w), clip[2].w) < frame.font.z) return;
  vec2 at[3] = vec2[](pixels_of(clip[0]), pixels_of(clip[1]), pixels_of(clip[2]));
  vec2 u = at[1] - at[0];
  vec2 v = at[2] - at[0];
  float turn = u.x * v.y - u.y * v.x < 0.0 ? -1.0 : 1.0;
  side_a = side(at[0], at[1], turn);
  side_b = side(at[1], at[2], turn);
  side_c = side(at[2], at[0], turn);
  // Partly covered pixels may have their centres outside the triangle.
  vec2 before = corner == 0u ? side_c.xy : corner == 1u ? side_a.xy : side_b.xy;
  vec2 after = corner == 0u ? side_a.xy : corner == 1u ? side_b.xy : side_c.xy;
  vec2 outward = -kReach_px * (before + after) / max(1.0 + dot(before, after), 1e-3);
  outward *= min(1.0, kLongest_px / max(length(outward), 1e-6));
  gl_Position.xy =
      (2.0 * (at[corner] + outward) / frame.target.xy - 1.0) * gl_Position.w;
}
