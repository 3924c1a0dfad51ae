#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "coverage.glsl"

layout(location = 0) flat in vec4 axis;
layout(location = 1) flat in vec2 radii;
layout(location = 0) out vec4 colour;

// Each segment writes how much of the background it leaves visible; alpha keeps the minimum.
void main() {
  vec2 along = axis.zw - axis.xy;
  float at = clamp(dot(gl_FragCoord.xy - axis.xy, along) / max(dot(along, along), 1e-8), 0.0, 1.0);
  vec2 from_axis = gl_FragCoord.xy - axis.xy - at * along;
  float off = length(from_axis);
  float part = covered(mix(radii.x, radii.y, at) - off, from_axis / max(off, 1e-6));
  colour = vec4(0, 0, 0, 1.0 - item.colour.a * part);
}
