// The data that every shader reads. Mirrors render/vulkan/gpu_types.h.
#extension GL_EXT_multiview : require

struct Eye {
  mat4 clip_from_world;
  vec4 position;
  vec4 scale;  // pixels per metre across and up at 1 m
};

layout(set = 0, binding = 0) uniform Frame {
  Eye eyes[2];
  vec4 target;  // width and height in pixels, -, -
  vec4 font;    // reach of the distances and rim width in cap heights, near plane in metres, -
  uvec4 mode;   // 1: over, 0: additive; -; -; -
}
frame;

layout(push_constant) uniform Item {
  mat4 place;
  vec4 colour;  // linear, not premultiplied
  vec4 extra;   // line: width in metres; text: colour of the rim; mesh: tint
  uvec4 ids;    // label, first vec4 of the item's data, style, line: 1 for discs at the ends
}
item;
