layout(set = 0, binding = 2) uniform sampler2D atlas;

layout(location = 0) in vec2 in_atlas;
layout(location = 1) in vec2 in_caps;
layout(location = 2) flat in vec4 ink;

// Cap heights from this pixel's centre to the outline, positive inside.
float distance_in_caps() { return (texture(atlas, in_atlas).r - 0.5) * 2.0 * frame.font.x; }

// The size of a pixel in cap heights.
float pixel_in_caps() { return 0.5 * (length(dFdx(in_caps)) + length(dFdy(in_caps))); }

// A rim is never thinner than a pixel, nor wider than the distances reach.
float rim_width(float pixel) {
  return clamp(pixel, frame.font.y, max(frame.font.y, frame.font.x - 0.5 * pixel));
}
