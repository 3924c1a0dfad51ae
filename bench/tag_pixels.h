#pragma once

#include <cmath>

#include "hal/api/devices.h"

namespace orthonav::bench {

/// Pixels of a tag's square in an image, by a callback.
template <class CameraFrame, class Visit>
void each_pixel(const CameraModel& camera, const Transform<CameraFrame, Rig>& camera_from_rig,
                const Transform<Rig, Marker>& rig_from_marker, double half_m, const Visit& visit) {
  const auto eye = (camera_from_rig * rig_from_marker).inverse();
  for (int y = 0; y < camera.height_px(); ++y) {
    for (int x = 0; x < camera.width_px(); ++x) {
      const std::size_t i = static_cast<std::size_t>(y * camera.width_px() + x);
      const Vec2 ray = camera.lookup()[i];
      if (std::isnan(ray.x)) {
        continue;
      }
      const Vec3 d = eye.rotation() * Vec3{ray.x, ray.y, 1.0};
      const double along = -eye.translation().z / d.z;
      const Vec3 p = eye.translation() + along * d;
      if (along > 0.0 && std::abs(p.x) < half_m && std::abs(p.y) < half_m) {
        visit(i);
      }
    }
  }
}

}  // namespace orthonav::bench
