#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "text.glsl"

layout(location = 0) out vec4 colour;

void main() {
  float pixel = pixel_in_caps();
  float inside = distance_in_caps();
  float fill = clamp(inside / pixel + 0.5, 0.0, 1.0) * ink.a;
  float around = clamp((inside + rim_width(pixel)) / pixel + 0.5, 0.0, 1.0) * (1.0 - fill);
  float rim = around * item.extra.a;
  // Dark where the rim leaves it: on bright ground a text stays legible. Added light has no dark.
  const float kHalo = 0.6;
  float halo = around * kHalo * ink.a * (1.0 - item.extra.a);
  colour = vec4(ink.rgb * fill + item.extra.rgb * rim, fill + rim + halo);
}
