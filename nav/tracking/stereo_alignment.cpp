#include "nav/tracking/stereo_alignment.h"

namespace orthonav::nav {

void rotate_right_camera(StereoCalibration& calibration, Vec3 rotation_rad) {
  const Transform<RightCamera, RightCamera> correction(rotation_from_vector(rotation_rad), {});
  calibration.right_from_rig = correction * calibration.right_from_rig;
}

}  // namespace orthonav::nav
