#include "nav/tracking/pixel_box.h"

#include <algorithm>

namespace orthonav::nav {

PixelBox in_whole_steps(const PixelBox& box, const GreyImage& image, int step_px) {
  const auto low = [step_px](long long v) {
    return static_cast<int>(std::max<long long>(0, (v >= 0 ? v / step_px : -1) - 1) * step_px);
  };
  const auto high = [step_px](long long v, int size) {
    if (v <= 0) {
      return 0;
    }
    return static_cast<int>(std::min<long long>(size, ((v + step_px - 1) / step_px + 1) * step_px));
  };
  const long long right = static_cast<long long>(box.x_px) + box.width_px;
  const long long bottom = static_cast<long long>(box.y_px) + box.height_px;
  const int x0 = low(box.x_px);
  const int y0 = low(box.y_px);
  return {x0, y0, high(right, image.width_px) - x0, high(bottom, image.height_px) - y0};
}

}  // namespace orthonav::nav
