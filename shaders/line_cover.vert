#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "coverage.glsl"
#include "line_ends.glsl"

// Where the segment lies, and how thick it is, in pixels.
layout(location = 0) flat out vec4 axis;
layout(location = 1) flat out vec2 radii;

// The line's two passes must agree to the bit on where something hides it.
invariant gl_Position;

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
  // A segment that continues others smoothly needs no discs at its ends, only slightly more than
  // its length.
  float ahead = item.ids.w == 0u ? 0.2 : 1.0;
  vec2 offset =
      ((corner & 1u) == 0u ? across : -across) + ahead * (first ? -ends.along : ends.along);
  float reach = (first ? ends.radius_a : ends.radius_b) + kReach_px;
  // Depth changes along it as along the pill in line.vert, which reaches the depth of the second
  // end at its sides there, and in the middle only at the end of the disc.
  float span = distance(ends.a.xy, ends.b.xy);
  float depth_a = ends.a.z / ends.a.w;
  float depth_b = ends.b.z / ends.b.w;
  float at = (first ? -ahead * reach : span + ahead * reach) / (span + 0.5 * ends.radius_b);
  float depth = span > 0.0 ? clamp(mix(depth_a, depth_b, at), 0.0, 1.0) : depth_a;
  vec2 at_px = (first ? ends.a.xy : ends.b.xy) + reach * offset;
  gl_Position = vec4(2.0 * at_px / frame.target.xy - 1.0, depth, 1);
}
