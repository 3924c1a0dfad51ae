#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "coverage.glsl"
#include "line_ends.glsl"

// Where the segment lies, and how thick it is, in pixels.
layout(location = 0) flat out vec4 axis;
layout(location = 1) flat out vec2 radii;

// A segment is drawn as a rectangle around it, whose corners are numbered as in a Z.
void main() {
  uint corner = uint(gl_VertexIndex) % 4u;
  Ends ends = ends_of(uint(gl_VertexIndex) / 4u);
  axis = vec4(0);
  radii = vec2(0);
  if (!ends.shown) {
    gl_Position = vec4(0, 0, -1, 1);  // outside: behind the near plane
    return;
  }
  axis = vec4(ends.a.xy, ends.b.xy);
  radii = vec2(ends.radius_a, ends.radius_b);
  bool first = corner < 2u;
  vec2 across = vec2(-ends.along.y, ends.along.x);
  vec2 offset = ((corner & 1u) == 0u ? across : -across) + (first ? -ends.along : ends.along);
  vec4 end = first ? ends.a : ends.b;
  float reach = (first ? ends.radius_a : ends.radius_b) + kReach_px;
  gl_Position = to_clip(end.xy + reach * offset, end);
}
