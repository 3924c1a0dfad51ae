#include <cmath>

#include "engine/live/camera_files.h"
#include "tests/fuzz/input_file.h"

namespace orthonav::fuzz {

/// Files of `calibrate stereo` and of other calibrators: an accepted one has finite lenses and a
/// rigid pose.
void fuzz_calibration(std::span<const std::uint8_t> input) {
  const InputFile file(input);
  const auto calibration = engine::load_cameras(file.path());
  if (!calibration) {
    insist_one_line(calibration.error());
    return;
  }
  const auto& rotation = calibration->right_from_left.rotation();
  insist(calibration->right_from_left.translation().is_finite());
  for (int axis = 0; axis < 3; ++axis) {
    insist(std::abs(rotation.column(axis).norm() - 1.0) < 1e-3);
  }
  if (calibration->lenses) {
    for (const CameraModel* lens : {&calibration->lenses->left, &calibration->lenses->right}) {
      insist(lens->width_px() > 0 && lens->height_px() > 0);
    }
  }
}

}  // namespace orthonav::fuzz
