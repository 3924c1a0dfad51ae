#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) in vec3 position;
layout(location = 1) in vec3 normal;
layout(location = 2) in float tint;
layout(location = 0) out vec3 normal_in_world;
layout(location = 1) out vec3 towards_eye;
layout(location = 2) out vec3 shade;

// The depth pass and the colour pass must agree to the bit.
invariant gl_Position;

void main() {
  vec4 in_world = item.place * vec4(position, 1);
  normal_in_world = mat3(item.place) * normal;
  towards_eye = frame.eyes[gl_ViewIndex].position.xyz - in_world.xyz;
  shade = mix(item.colour.rgb, item.extra.rgb, tint);
  gl_Position = frame.eyes[gl_ViewIndex].clip_from_world * in_world;
}
