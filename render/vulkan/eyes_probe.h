#pragma once

#include "render/text/font.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/commands.h"
#include "render/vulkan/device.h"

namespace orthonav::render {

/// Whether the device draws both eyes of one pass completely. llvmpipe of Mesa 22.3 puts the lines
/// and triangles of every view into the first layer, so the right eye misses them. A hologram
/// missing in one eye is worse than a slower frame, so the device itself is tested, not its name.
/// Draws one small frame that is thrown away. Images must be bound before the call, and buffers
/// bound again after it.
[[nodiscard]] bool draws_both_eyes_whole(const Device& device, Commands& commands,
                                         const Bindings& bindings, const Font& font);

}  // namespace orthonav::render
