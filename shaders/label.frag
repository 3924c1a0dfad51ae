#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"

layout(location = 0) out uint label;

void main() { label = item.ids.x; }
