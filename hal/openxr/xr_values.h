#pragma once

#include "base/result.h"
#include "base/transform.h"
#include "hal/api/pixel_display.h"
#include "hal/openxr/xr.h"

namespace orthonav::openxr {

struct Space;   ///< the reference space of the runtime: +y up, metres
struct Viewer;  ///< the runtime's VIEW space: between the eyes, x right, y up, -z forward

/// Refuses an invalid rotation: the length of a runtime's quaternion must be 1 within 1 %.
template <class A, class B>
[[nodiscard]] Result<Transform<A, B>> transform_of(const XrPosef& pose) {
  const double x = static_cast<double>(pose.orientation.x);
  const double y = static_cast<double>(pose.orientation.y);
  const double z = static_cast<double>(pose.orientation.z);
  const double w = static_cast<double>(pose.orientation.w);
  const double squared = x * x + y * y + z * z + w * w;
  if (!(squared > 0.98 && squared < 1.02)) {
    return Error{"openxr: a pose's quaternion has the squared length " + std::to_string(squared) +
                 ", must be 1 within 0.02"};
  }
  const double s = 2.0 / squared;
  const Mat3 rotation = {{{{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                           {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                           {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}}}};
  return Transform<A, B>::checked(
      rotation, {static_cast<double>(pose.position.x), static_cast<double>(pose.position.y),
                 static_cast<double>(pose.position.z)});
}

/// The tangents of a field of view; refuses one that is empty or a half space.
[[nodiscard]] Status take_fov(const XrFovf& fov, EyeView& view);

}  // namespace orthonav::openxr
