#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orthonav {

/// One number per pixel, row-major, without padding. Pixel (0, 0) is the top left; in continuous
/// pixel coordinates its centre is at (0.5, 0.5), everywhere in orthonav.
template <class Value>
struct PlainImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<Value> pixels;

  PlainImage() = default;
  PlainImage(int width, int height, Value value = 0)
      : width_px(width),
        height_px(height),
        pixels(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), value) {}

  [[nodiscard]] Value at(int x_px, int y_px) const {
    return pixels[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x_px)];
  }
  Value& at(int x_px, int y_px) {
    return pixels[static_cast<std::size_t>(y_px) * static_cast<std::size_t>(width_px) +
                  static_cast<std::size_t>(x_px)];
  }
  /// Empties it and keeps the buffer.
  void clear() {
    width_px = 0;
    height_px = 0;
    pixels.clear();
  }
  friend bool operator==(const PlainImage&, const PlainImage&) = default;
};
using GreyImage = PlainImage<std::uint8_t>;
/// 16 bits per pixel: distances in mm or brightness, as its owner says.
using DepthImage = PlainImage<std::uint16_t>;

/// 8-bit RGBA image, row-major, sRGB-encoded colour.
struct RgbaImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;  ///< 4 bytes per pixel

  friend bool operator==(const RgbaImage&, const RgbaImage&) = default;
};

/// An integer for each pixel's centre: the hologram visible there, 0 where there is none.
struct LabelImage {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint32_t> labels;

  friend bool operator==(const LabelImage&, const LabelImage&) = default;
};

}  // namespace orthonav
