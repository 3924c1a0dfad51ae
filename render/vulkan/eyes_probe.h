#pragma once

#include "render/text/font.h"
#include "render/vulkan/bindings.h"
#include "render/vulkan/commands.h"
#include "render/vulkan/device.h"

namespace orthonav::render {

/// Whether the device draws both eyes of one pass completely. llvmpipe of Mesa 22.3 puts lines and
/// triangles into the first layer, whatever the view: the right eye misses them. A hologram that
/// one eye lacks is worse than a slower frame, so the device is tested and not its name. With
/// `samples`, it must also resolve samples into both layers. Draws one or two small frames that are
/// thrown away. Images must be bound before this, and buffers again after it.
[[nodiscard]] bool draws_both_eyes_whole(const Device& device, Commands& commands,
                                         const Bindings& bindings, const Font& font, bool samples);

}  // namespace orthonav::render
