#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "hal/api/forwarding_headset.h"

namespace orthonav::engine {

/// The result of `orthonav calibrate stereo`.
struct CalibrationFile {
  struct Lenses {
    CameraModel left;
    CameraModel right;
  };
  std::string name;              ///< of the file
  std::optional<Lenses> lenses;  ///< absent: the device's, since a recording does not determine
                                 ///< them
  Transform<RightCamera, LeftCamera> right_from_left;
};

/// Reads the JSON of `calibrate stereo`. Refuses, naming file and field, missing fields and wrong
/// types, a pose that is not rigid, lenses that fold over, and a calibration with the verdict fail.
Result<CalibrationFile> load_calibration(const std::string& path);

/// A headset with its cameras as calibrated, not as the device describes them. The left camera
/// keeps its place in the rig; the right one is placed relative to it. Borrows the headset.
class CalibratedHeadset : public ForwardingHeadset {
 public:
  /// Refuses lenses for a different image size than the device's.
  static Result<std::unique_ptr<CalibratedHeadset>> create(Headset& headset,
                                                           const CalibrationFile& file);
  [[nodiscard]] StereoCamera* cameras() override { return &cameras_; }

 private:
  class Cameras : public ForwardingCamera {
   public:
    Cameras(StereoCamera& inner, StereoCalibration calibration)
        : ForwardingCamera(inner), calibration_(std::move(calibration)) {}

   private:
    [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }

    StereoCalibration calibration_;
  };

  CalibratedHeadset(Headset& headset, StereoCalibration calibration)
      : ForwardingHeadset(headset), cameras_(*headset.cameras(), std::move(calibration)) {}

  Cameras cameras_;
};

}  // namespace orthonav::engine
