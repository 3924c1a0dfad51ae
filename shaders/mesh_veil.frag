#version 450
#extension GL_GOOGLE_include_directive : require
#include "frame.glsl"
#include "shade.glsl"

layout(set = 0, binding = 3) uniform sampler2DArray background;
// A constant, since a software rasterizer fetches in both cases where a variable decides.
layout(constant_id = 0) const bool kHasBackground = false;

layout(location = 0) in vec4 normal_and_tint;
layout(location = 1) in vec3 towards_eye;
layout(location = 0) out vec4 colour;

// Only the nearest veil is visible, so it replaces the colour below instead of blending with it:
// only the background can lie below, and it is fetched here. One pass, no sorting.
void main() {
  float light = item.ids.z == 1u ? rim_light(normal_and_tint.xyz, towards_eye)
                                 : headlight(normal_and_tint.xyz, towards_eye);
  vec3 below = vec3(0);
  if (kHasBackground) {
    below = texelFetch(background, ivec3(gl_FragCoord.xy, gl_ViewIndex), 0).rgb;
  }
  // A rim is as opaque as it is bright: where it is faint, the bone shows through.
  float opacity = item.ids.z == 1u ? min(item.colour.a * light, 1.0) : item.colour.a;
  float kept = frame.mode.x == 1u ? 1.0 - opacity : 1.0;
  vec3 shade = mix(item.colour.rgb, item.extra.rgb, normal_and_tint.w);
  vec3 added = shade * min(item.colour.a * light, 1.0);
  colour = vec4(below * kept + added, opacity);
}
