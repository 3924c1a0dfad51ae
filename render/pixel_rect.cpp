#include "render/pixel_rect.h"

#include <cstddef>
#include <limits>

namespace orthonav::render {
namespace {

constexpr std::size_t kMaxRegions = 6;
constexpr long kPassCost_px =
    128L * 128;  // the cost of one more pass, in pixels to clear and resolve

/// The number of extra pixels drawn when two regions are joined.
long waste(const PixelRect& a, const PixelRect& b) {
  return joined(a, b).area() - a.area() - b.area();
}

}  // namespace

void add_region(std::vector<PixelRect>& regions, PixelRect rect) {
  if (rect.empty()) {
    return;
  }
  // Each round removes a region, so this ends.
  while (!regions.empty()) {
    std::size_t best = 0;
    long least = std::numeric_limits<long>::max();
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const long cost =
          touch(regions[i], rect) ? std::numeric_limits<long>::min() : waste(regions[i], rect);
      if (cost < least) {
        least = cost;
        best = i;
      }
    }
    if (least > kPassCost_px && regions.size() < kMaxRegions) {
      break;
    }
    rect = joined(regions[best], rect);
    regions[best] = regions.back();
    regions.pop_back();
  }
  regions.push_back(rect);
}

}  // namespace orthonav::render
