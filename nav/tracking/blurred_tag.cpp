#include "nav/tracking/blurred_tag.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace orthonav::nav {
namespace {

/// From the two neighbours in a row that are nearest to the middle of the image and have
/// directions.
double focal_px_of(const CameraModel& camera) {
  const std::span<const Vec2> rays = camera.lookup();
  const int w = camera.width_px();
  double nearest = 1e18;
  double focal = 1.0;
  for (int y = 0; y < camera.height_px(); ++y) {
    for (int x = 1; x < w; ++x) {
      const double off = std::hypot(x - 0.5 * w, y - 0.5 * camera.height_px());
      if (off >= nearest) {
        continue;
      }
      const auto i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x);
      const double step = (rays[i] - rays[i - 1]).norm();
      if (!(step > 0.0)) {
        continue;
      }
      nearest = off;
      focal = 1.0 / step;
    }
  }
  return focal;
}

}  // namespace

RayTable::RayTable(const CameraModel& camera)
    : width_px(camera.width_px()), height_px(camera.height_px()) {
  x.reserve(camera.lookup().size());
  y.reserve(camera.lookup().size());
  for (const Vec2 ray : camera.lookup()) {
    x.push_back(static_cast<float>(ray.x));
    y.push_back(static_cast<float>(ray.y));
  }
  focal_px = focal_px_of(camera);
}

BlurredTag::BlurredTag(TagTemplate tag, double size_m)
    : tag_(std::move(tag)), cell_m_(tag_.cell_m(size_m)) {
  const int n = tag_.cells;
  coefficients_.assign(static_cast<std::size_t>(12 * n * n), 0.0F);
  const auto at = [&](int row, int column) {
    return tag_.at(std::clamp(row, 0, n - 1), std::clamp(column, 0, n - 1));
  };
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      float* c = coefficients_.data() + 12 * static_cast<std::size_t>(row * n + column);
      const float here = at(row, column);
      const float left = at(row, column - 1);
      const float right = at(row, column + 1);
      const float above = at(row - 1, column);
      const float below = at(row + 1, column);
      c[0] = here;
      c[1] = left - here;
      c[2] = right - here;
      c[3] = above - here;
      c[4] = below - here;
      c[5] = at(row - 1, column - 1) - left - above + here;
      c[6] = at(row + 1, column - 1) - left - below + here;
      c[7] = at(row - 1, column + 1) - right - above + here;
      c[8] = at(row + 1, column + 1) - right - below + here;
    }
  }
}

}  // namespace orthonav::nav
