#pragma once

#include <cstddef>
#include <span>

#include "render/pixel_rect.h"
#include "render/renderer.h"

namespace orthonav::render {

// An image of the renderer's size is filled in two steps: while the device draws, with what is seen
// where there is no hologram; then the regions that were drawn are copied into it.

/// Sets the size of an image. After this nothing is allocated.
void resize(RgbaImage& image, int width_px, int height_px);
void resize(LabelImage& image, int width_px, int height_px);

/// Opaque: the background, or black without one.
void fill(RgbaImage& image, const RgbaImage* background);
/// No hologram, whatever the background.
void fill(LabelImage& image, const RgbaImage* background);

/// `drawn` holds a whole image, of which only the regions are valid.
void take(const std::byte* drawn, std::span<const PixelRect> regions, RgbaImage& image);
void take(const std::byte* drawn, std::span<const PixelRect> regions, LabelImage& image);

}  // namespace orthonav::render
