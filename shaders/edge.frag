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

const float kRounding = 0.02;
const float kLeast = 0.5 / 255.0;

float difference(vec3 a, vec3 b) {
  vec3 off = abs(a - b);
  return max(max(off.r, off.g), off.b);
}

float sum(vec3 c) { return c.r + c.g + c.b; }

// The colour of a surface `at_px` from its edge, from that of a pixel `near_px` from it and that of
// the next one behind. On a round surface the cosine between normal and eye grows as the root of
// the distance from the edge. `far` may belong to another surface, so the hue is kept.
vec3 continued(vec3 near, vec3 far, float near_px, float at_px) {
  float grown = 1.0 - sum(far) / max(sum(near), 1e-3);
  float by = (sqrt(near_px) - sqrt(at_px)) / (sqrt(near_px + 1.0) - sqrt(near_px));
  return min(near * clamp(1.0 + by * grown, 0.5, 2.0), 1.0);
}

// A pixel that a surface's edge cuts is a blend of its own colour and, in proportion to the part
// that the edge cuts off, the colour of its neighbour on the other side. After E. Persson,
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
  vec3 own = drawn_at(pixel);
  vec3 next = drawn_at(pixel + beside);
  // If the edge runs through the centre, rounding decides on which side the device put it.
  if (abs(off) < kRounding) {
    vec3 back = drawn_at(pixel - beside);
    if (difference(own, back) > difference(own, next)) {
      beside = -beside;
      next = back;
    }
  }
  // Several edges may cut one pixel, some of them hidden: the depth test keeps the one that changes
  // the pixel most. Whatever is farther than twice the near plane lies behind all of them.
  float change = other * difference(own, next);
  if (change < kLeast) discard;
  gl_FragDepth = 0.5 * (1.0 - change);
  // Shading changes fastest at a surface's edge, so it is extrapolated from the surface's two
  // nearest pixels to the middle of its part of this pixel. The surface lies to the left of its
  // edge.
  bool outside = along.y * float(beside.x) > along.x * float(beside.y);
  vec3 inner = drawn_at(outside ? pixel + 2 * beside : pixel - beside);
  float distance_px = min(abs(off), 0.5);
  float near_px = outside ? 1.0 - distance_px : distance_px;
  float middle_px = outside ? 0.25 - 0.5 * distance_px : 0.25 + 0.5 * distance_px;
  colour = vec4(outside ? mix(own, continued(next, inner, near_px, middle_px), other)
                        : mix(continued(own, inner, near_px, middle_px), next, other),
                1);
}
