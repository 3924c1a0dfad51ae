#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "text.glsl"

void main() {
  if (distance_in_caps() < 0.0) discard;
}
