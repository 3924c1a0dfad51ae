#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shade.glsl"

layout(location = 0) in vec4 normal_and_tint;
layout(location = 1) in vec3 towards_eye;
layout(location = 0) out vec4 colour;

void main() {
  vec3 shade = mix(item.colour.rgb, item.extra.rgb, normal_and_tint.w);
  colour = vec4(shade * headlight(normal_and_tint.xyz, towards_eye), 1);
}
