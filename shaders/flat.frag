#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) out vec4 colour;

void main() { colour = vec4(item.colour.rgb * item.colour.a, item.colour.a); }
