#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "text.glsl"

layout(location = 0) out vec4 colour;

void main() {
  float pixel = pixel_in_caps();
  float inside = distance_in_caps();
  float fill = clamp(inside / pixel + 0.5, 0.0, 1.0) * ink.a;
  float rim = clamp((inside + rim_width(pixel)) / pixel + 0.5, 0.0, 1.0) * item.extra.a;
  rim *= 1.0 - fill;
  colour = vec4(ink.rgb * fill + item.extra.rgb * rim, fill + rim);
}
