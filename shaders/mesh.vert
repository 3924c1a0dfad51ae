#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float tint;
// For a software rasterizer, outputs of a triangle cost as much as its pixels: two vectors, not
// three.
layout(location = 0) out vec4 normal_and_tint;  // in World
layout(location = 1) out vec3 towards_eye;

// The depth pass and the colour pass must agree to the bit.
invariant gl_Position;

void main() {
  vec4 in_world = item.place * vec4(position, 1);
  normal_and_tint = vec4(mat3(item.place) * normal, tint);
  towards_eye = frame.eyes[gl_ViewIndex].position.xyz - in_world.xyz;
  gl_Position = frame.eyes[gl_ViewIndex].clip_from_world * in_world;
}
