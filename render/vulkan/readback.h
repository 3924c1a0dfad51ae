#pragma once

#include <cstddef>
#include <span>

#include "render/pixel_rect.h"
#include "render/renderer.h"

namespace orthonav::render {

// Fills an image of a given size from what was read back: the regions that were drawn, and around
// them what is seen where there is no hologram. `drawn` holds a whole image.

/// Around the regions: the background, or opaque black without one.
void take(const std::byte* drawn, std::span<const PixelRect> regions, const RgbaImage* background,
          RgbaImage& image);
/// Around the regions: no hologram.
void take(const std::byte* drawn, std::span<const PixelRect> regions, LabelImage& image);

}  // namespace orthonav::render
