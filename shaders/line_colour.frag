#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) out vec4 colour;

// Blended by what alpha lacks; alpha is then reset, so the rest of the line adds nothing here.
void main() { colour = vec4(item.colour.rgb, 1); }
