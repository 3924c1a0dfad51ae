#version 450
#extension GL_GOOGLE_include_directive : require
#include "coverage.glsl"

layout(set = 0, binding = 4) uniform sampler2DArray drawn;

layout(location = 0) flat in vec4 edge;
layout(location = 1) flat in int view;
layout(location = 0) out vec4 colour;

vec3 drawn_at(ivec2 pixel) {
  return texelFetch(drawn, ivec3(clamp(pixel, ivec2(0), textureSize(drawn, 0).xy - 1), view), 0).rgb;
}

// A pixel that a surface's edge cuts shows both what lies on its own side and, by the part that the
// edge cuts off, what lies on the other: the colour of its neighbour there. After E. Persson,
// "Geometric post-process anti-aliasing", 2011.
void main() {
  vec2 along = edge.zw - edge.xy;
  bool upright = abs(along.x) < abs(along.y);
  vec2 from = gl_FragCoord.xy - edge.xy;
  float off = upright ? from.y * along.x / along.y - from.x : from.x * along.y / along.x - from.y;
  vec2 normal = vec2(-along.y, along.x) / length(along);
  float other = covered(-abs(off) * max(abs(normal.x), abs(normal.y)), normal);
  if (!(other > 0.0)) discard;
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  ivec2 beside = (upright ? ivec2(1, 0) : ivec2(0, 1)) * (off < 0.0 ? -1 : 1);
  colour = vec4(mix(drawn_at(pixel), drawn_at(pixel + beside), other), 1);
}
