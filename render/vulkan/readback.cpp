#include "render/vulkan/readback.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
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

template <class Image>
std::size_t pixels_of(const Image& image) {
  return static_cast<std::size_t>(image.width_px) * image.height_px;
}

/// Copies pixels and makes them opaque.
void copy_opaque(const std::uint8_t* from, std::uint8_t* to, std::size_t pixels) {
  constexpr std::array<std::uint8_t, 4> kAlpha = {0, 0, 0, 255};
  const auto alpha = std::bit_cast<std::uint32_t>(kAlpha);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::uint32_t pixel = 0;
    std::memcpy(&pixel, from + 4 * i, 4);
    pixel |= alpha;
    std::memcpy(to + 4 * i, &pixel, 4);
  }
}

}  // namespace

void resize(RgbaImage& image, int width_px, int height_px) {
  image.width_px = width_px;
  image.height_px = height_px;
  image.pixels.resize(4 * pixels_of(image));
}

void resize(LabelImage& image, int width_px, int height_px) {
  image.width_px = width_px;
  image.height_px = height_px;
  image.labels.resize(pixels_of(image));
}

void fill(RgbaImage& image, const RgbaImage* background) {
  if (background != nullptr) {
    return copy_opaque(background->pixels.data(), image.pixels.data(), pixels_of(image));
  }
  constexpr std::array<std::uint8_t, 4> kBlack = {0, 0, 0, 255};
  const std::size_t pixels = pixels_of(image);
  for (std::size_t i = 0; i < pixels; ++i) {
    std::memcpy(image.pixels.data() + 4 * i, kBlack.data(), 4);
  }
}

void fill(LabelImage& image, const RgbaImage*) {
  std::fill(image.labels.begin(), image.labels.end(), 0);
}

void take(const std::byte* drawn, std::span<const PixelRect> regions, RgbaImage& image) {
  take_regions(drawn, regions, image.width_px, image.pixels.data());
}

void take(const std::byte* drawn, std::span<const PixelRect> regions, LabelImage& image) {
  take_regions(drawn, regions, image.width_px, image.labels.data());
}

}  // namespace orthonav::render
