#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(set = 0, binding = 1) readonly buffer Data { vec4 data[]; };

layout(location = 0) out vec2 in_atlas;
layout(location = 1) out vec2 in_caps;
layout(location = 2) flat out vec4 ink;

void main() {
  const uint corners[6] = uint[](0u, 1u, 2u, 2u, 1u, 3u);
  uint glyph = item.ids.y + 3u * (uint(gl_VertexIndex) / 6u);
  uint corner = corners[gl_VertexIndex % 6];
  bool right = (corner & 1u) != 0u;
  bool top = (corner & 2u) != 0u;
  vec4 rectangle = data[glyph];
  vec4 texture_rectangle = data[glyph + 1u];
  ink = data[glyph + 2u];
  in_caps = vec2(right ? rectangle.z : rectangle.x, top ? rectangle.w : rectangle.y);
  in_atlas = vec2(right ? texture_rectangle.z : texture_rectangle.x,
                  top ? texture_rectangle.y : texture_rectangle.w);
  gl_Position = frame.eyes[gl_ViewIndex].clip_from_world * item.place * vec4(in_caps, 0, 1);
}
