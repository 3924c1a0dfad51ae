#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/result.h"
#include "hal/api/forwarding_headset.h"

namespace orthonav::engine {

/// What `orthonav calibrate stereo` found.
struct CalibrationFile {
  struct Lenses {
    CameraModel left;
    CameraModel right;
  };
  std::string name;              ///< of the file
  std::optional<Lenses> lenses;  ///< absent: as the device has them, a recording does not tell
  Transform<RightCamera, LeftCamera> right_from_left;
};

/// Reads the JSON of `calibrate stereo`. Refuses, naming file and field, what is missing or of the
/// wrong type, a pose that is not rigid, lenses that fold over, and a calibration whose verdict was
/// fail.
Result<CalibrationFile> load_calibration(const std::string& path);

/// A headset with its cameras as calibrated, not as the device describes them. The left camera
/// keeps its place in the rig; the right one is placed relative to it. Borrows the headset.
class CalibratedHeadset : public ForwardingHeadset {
 public:
  /// Refuses lenses of images of another size than the device's.
  static Result<std::unique_ptr<CalibratedHeadset>> create(Headset& headset,
                                                           const CalibrationFile& file);
  [[nodiscard]] StereoCamera& cameras() override { return cameras_; }

 private:
  class Cameras : public StereoCamera {
   public:
    Cameras(StereoCamera& inner, StereoCalibration calibration)
        : inner_(inner), calibration_(std::move(calibration)) {}

   private:
    [[nodiscard]] const StereoCalibration& do_calibration() const override { return calibration_; }
    Result<Next> do_next(StereoFrame& frame) override { return inner_.next(frame); }

    StereoCamera& inner_;
    StereoCalibration calibration_;
  };

  CalibratedHeadset(Headset& headset, StereoCalibration calibration)
      : ForwardingHeadset(headset), cameras_(headset.cameras(), std::move(calibration)) {}

  Cameras cameras_;
};

}  // namespace orthonav::engine
