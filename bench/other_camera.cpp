#include "bench/other_camera.h"

#include <cmath>

namespace orthonav::bench {

Vec2 Lens::pixel(Vec2 u) const {
  const double r2 = u.dot(u);
  const double radial = 1.0 + r2 * (k1 + r2 * k2);
  return {centre_px.x + f_px * (u.x * radial + 2.0 * p1 * u.x * u.y + p2 * (r2 + 2.0 * u.x * u.x)),
          centre_px.y + f_px * (u.y * radial + p1 * (r2 + 2.0 * u.y * u.y) + 2.0 * p2 * u.x * u.y)};
}

Vec2 Lens::unit_plane(Vec2 pixel_px) const {
  Vec2 u = (1.0 / f_px) * (pixel_px - centre_px);
  constexpr double kStep = 1e-6;
  for (int i = 0; i < 30; ++i) {
    const Vec2 off = pixel_px - pixel(u);
    if (off.norm() < 1e-10) {
      break;
    }
    const Vec2 a = (0.5 / kStep) * (pixel({u.x + kStep, u.y}) - pixel({u.x - kStep, u.y}));
    const Vec2 b = (0.5 / kStep) * (pixel({u.x, u.y + kStep}) - pixel({u.x, u.y - kStep}));
    const double det = a.x * b.y - a.y * b.x;
    u = u + Vec2{(off.x * b.y - off.y * b.x) / det, (a.x * off.y - a.y * off.x) / det};
  }
  return u;
}

RayGrid::RayGrid(const Lens& lens) : lens_(lens) {
  for (int y = 0; y <= lens.height_px; ++y) {
    for (int x = 0; x <= lens.width_px; ++x) {
      nodes_.push_back(lens.unit_plane({static_cast<double>(x), static_cast<double>(y)}));
    }
  }
}

CameraModel reported(const Lens& lens) {
  std::vector<Vec2> table;
  for (int y = 0; y < lens.height_px; ++y) {
    for (int x = 0; x < lens.width_px; ++x) {
      table.push_back(lens.unit_plane({x + 0.5, y + 0.5}));
    }
  }
  return CameraModel::from_lookup(lens.width_px, lens.height_px, std::move(table)).value();
}

}  // namespace orthonav::bench
