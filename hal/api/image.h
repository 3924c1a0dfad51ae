#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orthonav {

/// 8-bit grey image, row-major, no padding. Pixel (0, 0) is the top left; in continuous pixel
/// coordinates its centre is at (0.5, 0.5), everywhere in orthonav.
struct GreyImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;

  GreyImage() = default;
  GreyImage(int width, int height, std::uint8_t value = 0)
      : width_px(width),
        height_px(height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  [[nodiscard]] std::uint8_t at(int x_px, int y_px) const {
    return pixels[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x_px)];
  }
  std::uint8_t& at(int x_px, int y_px) {
    return pixels[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x_px)];
  }
  friend bool operator==(const GreyImage&, const GreyImage&) = default;
};

/// 8-bit RGBA image, row-major, sRGB-encoded colour.
struct RgbaImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 bytes a pixel

  friend bool operator==(const RgbaImage&, const RgbaImage&) = default;
};

}  // namespace orthonav
