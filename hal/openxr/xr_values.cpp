#include "hal/openxr/xr_values.h"

#include <cmath>
#include <string>

#include "base/printed.h"

namespace orthonav::openxr {

Status take_fov(const XrFovf& fov, EyeView& view) {
  view.tan_left = -std::tan(static_cast<double>(fov.angleLeft));
  view.tan_right = std::tan(static_cast<double>(fov.angleRight));
  view.tan_up = std::tan(static_cast<double>(fov.angleUp));
  view.tan_down = -std::tan(static_cast<double>(fov.angleDown));
  constexpr float kMax_rad = 1.55f;  // a little less than a right angle
  for (const float angle : {fov.angleLeft, fov.angleRight, fov.angleUp, fov.angleDown}) {
    if (!(std::fabs(angle) < kMax_rad)) {
      return Error{"openxr: a field of view reaches " + printed("%f", angle) + " rad, limit " +
                   std::to_string(kMax_rad)};
    }
  }
  if (fov.angleLeft >= fov.angleRight || fov.angleDown >= fov.angleUp) {
    return Error{"openxr: a field of view of " + std::to_string(fov.angleRight - fov.angleLeft) +
                 " x " + std::to_string(fov.angleUp - fov.angleDown) + " rad, must be positive"};
  }
  return {};
}

}  // namespace orthonav::openxr
