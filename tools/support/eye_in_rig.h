#pragma once

#include "base/transform.h"

namespace orthonav::tools {

/// Rig and Eye have the same axes; the eye lies between the two cameras' right half, 30 mm behind
/// them and a little below.
[[nodiscard]] inline Transform<Rig, Eye> rig_from_eye() {
  return {Mat3::identity(), Vec3{0.081, -0.010, 0.030}};
}

/// The point between the eyes, 63 mm apart, which lies as the eye above does.
[[nodiscard]] inline Transform<Rig, Eye> rig_from_eyes() {
  return {Mat3::identity(), Vec3{0.0495, -0.010, 0.030}};
}

}  // namespace orthonav::tools
