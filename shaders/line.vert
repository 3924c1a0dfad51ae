#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(set = 0, binding = 1) readonly buffer Data { vec4 data[]; };

// A segment is drawn as a pill of 14 corners: half a circle around either end.
const uint kCorners = 14u;
// One that follows on others smoothly is drawn with four of them alone, without its discs.
const float kLeastRadius_px = 0.75;

vec4 to_pixels(vec4 clip) {
  return vec4((0.5 * clip.xy / clip.w + 0.5) * frame.target.xy, clip.z, clip.w);
}

float radius_at(float depth) {
  return max(0.5 * item.extra.x * frame.eyes[gl_ViewIndex].scale.y / depth, kLeastRadius_px);
}

void main() {
  uint segment = uint(gl_VertexIndex) / kCorners;
  uint corner = uint(gl_VertexIndex) % kCorners;
  mat4 clip_from_world = frame.eyes[gl_ViewIndex].clip_from_world;
  vec4 a = clip_from_world * vec4(data[item.ids.y + 2u * segment].xyz, 1);
  vec4 b = clip_from_world * vec4(data[item.ids.y + 2u * segment + 1u].xyz, 1);
  float near = frame.font.z;
  if (a.w < near && b.w < near) {
    gl_Position = vec4(0, 0, -1, 1);  // outside: behind the near plane
    return;
  }
  // What lies behind the eye has no place on the screen: cut there before projecting.
  if (a.w < near) a = mix(a, b, (near - a.w) / (b.w - a.w));
  if (b.w < near) b = mix(b, a, (near - b.w) / (a.w - b.w));
  vec4 pa = to_pixels(a);
  vec4 pb = to_pixels(b);
  float radius_a = radius_at(pa.w);
  float radius_b = radius_at(pb.w);
  vec2 along = pb.xy - pa.xy;
  float span = length(along);
  // Seen from its end, the nearer end's disc covers all the rest.
  if (span <= abs(radius_a - radius_b) || span < 1e-4) {
    if (radius_a < radius_b) {
      pa = pb;
      radius_a = radius_b;
    } else {
      pb = pa;
      radius_b = radius_a;
    }
    along = vec2(1, 0);
  } else {
    along /= span;
  }
  bool first = corner < 7u;
  vec4 end = first ? pa : pb;
  float radius = first ? radius_a : radius_b;
  float turn = radians(30.0) * float(corner % 7u);
  vec2 across = vec2(-along.y, along.x);
  vec2 offset = (first ? 1.0 : -1.0) * (cos(turn) * across - sin(turn) * along);
  // Without discs, a little longer: it closes the gap where the line bends gently.
  if (item.ids.w == 0u) offset += (first ? -0.13 : 0.13) * along;
  vec2 at = end.xy + radius * offset;
  gl_Position = vec4((2.0 * at / frame.target.xy - 1.0) * end.w, end.z, end.w);
}
