#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "text.glsl"

layout(location = 0) out uint label;

void main() {
  float pixel = pixel_in_caps();
  float reach = item.extra.a > 0.0 ? rim_width(pixel) : 0.0;
  if (distance_in_caps() + reach < 0.0) discard;
  label = item.ids.x;
}
