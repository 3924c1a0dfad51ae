#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/hosted_renderer.h"
#include "render/vulkan/device.h"

namespace orthonav::render {

/// Every image that a pass may end in, chain after chain.
[[nodiscard]] std::vector<VkImage> outer_images(
    const std::vector<std::vector<std::uint64_t>>& chains);
/// Whether such images can be drawn into, whatever their formats.
[[nodiscard]] Status check_shape(const EyeImages& images, std::uint32_t most_px);
/// Whether each chain has an image with its index, the chains of depth after the others.
[[nodiscard]] bool holds(const EyeImages& images, std::span<const std::uint32_t> indices);

}  // namespace orthonav::render
