#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "render/frame/frame_items.h"
#include "render/scene.h"

namespace orthonav::render {

// What shaders/frame.glsl reads, byte for byte.

struct GpuEye {
  Matrix4 clip_from_world = kIdentity;
  Float4 position{};
  Float4 scale{};  ///< pixels per metre across and up at 1 m
};

struct GpuFrame {
  std::array<GpuEye, 2> eyes{};
  Float4 target{};    ///< width and height in px
  Float4 font{};      ///< reach and rim width in cap heights, near plane in metres
  glm::uvec4 mode{};  ///< over?
};
static_assert(sizeof(GpuFrame) == 2 * 96 + 48);
/// Offset from one pass's frame to the next in their buffer; every device supports this alignment.
inline constexpr std::uint32_t kFrameStride = 256;
static_assert(sizeof(GpuFrame) <= kFrameStride);

struct GpuItem {
  Matrix4 place = kIdentity;
  Colour colour;
  Float4 extra{};
  glm::uvec4 ids{};  ///< label, first, style, rounded
};
static_assert(sizeof(GpuItem) == 112, "fits the 128 bytes that every device has");

struct GpuVertex {
  Float3 position{};
  Float3 normal{};
  float tint = 0;
};
static_assert(sizeof(GpuVertex) == 28);

}  // namespace orthonav::render
