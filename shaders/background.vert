#version 450
#extension GL_EXT_multiview : require

layout(location = 0) flat out int view;

void main() {
  vec2 corner = vec2(gl_VertexIndex == 1 ? 3 : -1, gl_VertexIndex == 2 ? 3 : -1);
  view = gl_ViewIndex;
  gl_Position = vec4(corner, 1, 1);
}
