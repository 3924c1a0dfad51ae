#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(set = 0, binding = 1) readonly buffer Data { vec4 data[]; };

layout(location = 0) flat out vec4 edge;  // from, to; in pixels
layout(location = 1) flat out int view;

// A surface's edge as a strip of pixels: ids holds the first edge of each view, then the number of
// edges in each.
void main() {
  const uint corners[6] = uint[](0u, 1u, 2u, 2u, 1u, 3u);
  uint number = uint(gl_VertexIndex) / 6u;
  uint corner = corners[gl_VertexIndex % 6];
  view = gl_ViewIndex;
  edge = vec4(0);
  if (number >= item.ids[2 + gl_ViewIndex]) {
    gl_Position = vec4(0, 0, -1, 1);  // the other eye sees more edges
    return;
  }
  edge = data[item.ids[gl_ViewIndex] + number];
  vec2 along = edge.zw - edge.xy;
  // Along the axis that the edge crosses, the centres of the pixels that it cuts lie no farther
  // from it.
  float steep = max(abs(along.x), abs(along.y));
  float reach = 0.5 + 0.5 * min(abs(along.x), abs(along.y)) / steep;
  vec2 across = abs(along.x) < abs(along.y) ? vec2(reach, 0) : vec2(0, reach);
  vec2 at = ((corner & 2u) == 0u ? edge.xy : edge.zw) + ((corner & 1u) == 0u ? across : -across);
  gl_Position = vec4(2.0 * at / frame.target.xy - 1.0, 0, 1);
}
