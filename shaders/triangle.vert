#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(set = 0, binding = 1) readonly buffer Data { vec4 data[]; };

void main() {
  vec4 in_world = vec4(data[item.ids.y + uint(gl_VertexIndex)].xyz, 1);
  gl_Position = frame.eyes[gl_ViewIndex].clip_from_world * in_world;
}
