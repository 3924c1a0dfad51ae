#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shade.glsl"

layout(location = 0) in vec3 normal_in_world;
layout(location = 1) in vec3 towards_eye;
layout(location = 2) in vec3 shade;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(shade * headlight(normal_in_world, towards_eye), 1); }
