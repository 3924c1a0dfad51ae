#include "engine/live/rectified_camera.h"

#include <algorithm>

#include "nav/tracking/bilinear.h"

namespace orthonav::engine {

Transform<Rig, Eye> RectifiedCamera::rig_from_eye() const {
  return {Mat3::identity(), cameras_.left_from_rig.inverse().translation()};
}

void RectifiedCamera::make_map(const render::View& view, const RgbaImage& picture) {
  const Mat3& camera_from_eye = cameras_.left_from_rig.rotation();
  map_tan_ = view.tan_left;
  map_.resize(picture.pixels.size() / 4);
  const double across = static_cast<double>(view.tan_left + view.tan_right);
  const double down = static_cast<double>(view.tan_up + view.tan_down);
  std::size_t pixel = 0;
  for (int y = 0; y < picture.height_px; ++y) {
    for (int x = 0; x < picture.width_px; ++x) {
      const Vec3 ray{across * (x + 0.5) / picture.width_px - static_cast<double>(view.tan_left),
                     static_cast<double>(view.tan_up) - down * (y + 0.5) / picture.height_px, -1.0};
      map_[pixel++] = cameras_.left.project(camera_from_eye * ray).value_or(Vec2{-1.0, -1.0});
    }
  }
}

void RectifiedCamera::draw(const GreyImage& image, const render::View& view, RgbaImage& picture) {
  if (map_.size() * 4 != picture.pixels.size() || map_tan_ != view.tan_left) {
    make_map(view, picture);
  }
  for (std::size_t i = 0; i < map_.size(); ++i) {
    if (map_[i].x < 0.0) {
      continue;
    }
    const std::uint8_t grey = static_cast<std::uint8_t>(nav::grey_at(image, map_[i]) + 0.5);
    std::fill_n(picture.pixels.begin() + static_cast<long>(4 * i), 3, grey);
  }
}

}  // namespace orthonav::engine
