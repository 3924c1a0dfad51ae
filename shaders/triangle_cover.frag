#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "coverage.glsl"

layout(location = 0) flat in vec3 side_a;
layout(location = 1) flat in vec3 side_b;
layout(location = 2) flat in vec3 side_c;
layout(location = 0) out vec4 colour;

float within(vec3 side) { return covered(dot(side.xy, gl_FragCoord.xy) + side.z, side.xy); }

// A point outside one side is seldom outside another, so the parts of a pixel that the sides cut
// off are added up; this also holds for a strip thinner than a pixel.
void main() {
  float part = max(within(side_a) + within(side_b) + within(side_c) - 2.0, 0.0);
  float opacity = item.colour.a * part;
  colour = vec4(item.colour.rgb * opacity, opacity);
}
