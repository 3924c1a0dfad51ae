#version 450

layout(set = 0, binding = 3) uniform sampler2DArray background;
layout(location = 0) flat in int view;
layout(location = 0) out vec4 colour;

void main() { colour = vec4(texelFetch(background, ivec3(gl_FragCoord.xy, view), 0).rgb, 1); }
