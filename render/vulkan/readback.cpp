#include "render/vulkan/readback.h"

#include <cstring>

namespace orthonav::render {
namespace {

/// Four bytes per pixel, as in all images.
void take_regions(const std::byte* drawn, std::span<const PixelRect> regions, int width_px,
                  void* pixels) {
  auto* out = static_cast<std::byte*>(pixels);
  for (const PixelRect& region : regions) {
    for (int y = region.top; y < region.bottom; ++y) {
      const std::size_t at = 4 * (static_cast<std::size_t>(y) * width_px + region.left);
      std::memcpy(out + at, drawn + at, 4 * static_cast<std::size_t>(region.width()));
    }
  }
}

std::size_t pixels_of(const RgbaImage& image) {
  return static_cast<std::size_t>(image.width_px) * image.height_px;
}

}  // namespace

void take(const std::byte* drawn, std::span<const PixelRect> regions, const RgbaImage* background,
          RgbaImage& image) {
  image.pixels.resize(4 * pixels_of(image));
  if (background != nullptr) {
    std::memcpy(image.pixels.data(), background->pixels.data(), image.pixels.size());
  } else {
    std::memset(image.pixels.data(), 0, image.pixels.size());
  }
  for (std::size_t i = 3; i < image.pixels.size(); i += 4) {
    image.pixels[i] = 255;
  }
  take_regions(drawn, regions, image.width_px, image.pixels.data());
}

void take(const std::byte* drawn, std::span<const PixelRect> regions, LabelImage& image) {
  image.labels.assign(static_cast<std::size_t>(image.width_px) * image.height_px, 0);
  take_regions(drawn, regions, image.width_px, image.labels.data());
}

}  // namespace orthonav::render
