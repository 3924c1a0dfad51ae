#pragma once

#include <algorithm>
#include <vector>

namespace orthonav::render {

/// Pixels from the first column and row up to, but not including, the last; empty if it has no
/// extent.
struct PixelRect {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;
  [[nodiscard]] bool empty() const { return right <= left || bottom <= top; }
  [[nodiscard]] int width() const { return right - left; }
  [[nodiscard]] int height() const { return bottom - top; }
  [[nodiscard]] long area() const { return empty() ? 0 : long{width()} * height(); }
  friend bool operator==(const PixelRect&, const PixelRect&) = default;
};

/// The smallest rectangle that holds both.
[[nodiscard]] inline PixelRect joined(const PixelRect& a, const PixelRect& b) {
  if (a.empty()) {
    return b;
  }
  if (b.empty()) {
    return a;
  }
  return {std::min(a.left, b.left), std::min(a.top, b.top), std::max(a.right, b.right),
          std::max(a.bottom, b.bottom)};
}

/// The pixels that are in both.
[[nodiscard]] inline PixelRect overlap(const PixelRect& a, const PixelRect& b) {
  return {std::max(a.left, b.left), std::max(a.top, b.top), std::min(a.right, b.right),
          std::min(a.bottom, b.bottom)};
}

/// Whether they share a pixel.
[[nodiscard]] inline bool touch(const PixelRect& a, const PixelRect& b) {
  return !a.empty() && !b.empty() && a.left < b.right && b.left < a.right && a.top < b.bottom &&
         b.top < a.bottom;
}

/// Adds a rectangle to regions that share no pixel, so that they still share none and contain it.
/// Regions that are cheaper to draw as one are joined, and there are never more than a few.
void add_region(std::vector<PixelRect>& regions, PixelRect rect);

}  // namespace orthonav::render
