#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "line_ends.glsl"

// A segment is drawn as a pill of 14 corners: half a circle around either end.
const uint kCorners = 14u;
// A segment that continues others smoothly is drawn with only four of them, without its discs.

void main() {
  uint corner = uint(gl_VertexIndex) % kCorners;
  Ends ends = ends_of(uint(gl_VertexIndex) / kCorners);
  if (!ends.shown) {
    gl_Position = vec4(0, 0, -1, 1);  // outside: behind the near plane
    return;
  }
  bool first = corner < 7u;
  vec4 end = first ? ends.a : ends.b;
  float radius = first ? ends.radius_a : ends.radius_b;
  float turn = radians(30.0) * float(corner % 7u);
  vec2 across = vec2(-ends.along.y, ends.along.x);
  vec2 offset = (first ? 1.0 : -1.0) * (cos(turn) * across - sin(turn) * ends.along);
  // Without discs it is slightly longer, which closes the gap where the line bends gently.
  if (item.ids.w == 0u) offset += (first ? -0.13 : 0.13) * ends.along;
  vec2 at = end.xy + radius * offset;
  gl_Position = vec4((2.0 * at / frame.target.xy - 1.0) * end.w, end.z, end.w);
}
