#pragma once

#include <array>
#include <string>

#include "bench/other_renderer.h"
#include "bench/other_sensor.h"
#include "hal/api/devices.h"

namespace orthonav::bench {

/// The conditions of a sequence.
struct OtherKind {
  std::string name;
  bool large = true;  ///< true: 1280×960; false: 640×480
  double tag_m = 0.040;
  double distance_m = 0.45;
  Optics optics{Blur::kDisk, 0.8, 0.25};
  Sensor sensor;
  Lighting lighting;
  double exposure_s = 0.004;
  double speed = 1.0;           ///< of the hands; 1: about 0.1 m/s and 0.6 rad/s RMS
  double least_tilt_rad = 0.0;  ///< from facing the cameras
  double largest_tilt_rad = 0.45;
  double finger_m = 0.0;  ///< radius of the finger that wipes over the first tool's tag
};

[[nodiscard]] const std::vector<OtherKind>& other_kinds();

/// Two tools that wander in front of two swaying cameras, at any time.
class OtherStage {
 public:
  OtherStage(const OtherKind& kind, std::uint64_t seed);

  [[nodiscard]] Moment at(double t) const;
  /// An odd number of moments spread evenly over the exposure.
  [[nodiscard]] std::vector<Moment> exposure(double t) const;
  [[nodiscard]] const OtherKind& kind() const { return kind_; }
  [[nodiscard]] const std::array<RayGrid, 2>& rays() const { return rays_; }
  /// Left and right; to the renderer both are of one kind.
  [[nodiscard]] const std::array<Transform<LeftCamera, Rig>, 2>& camera_from_rig() const {
    return camera_from_rig_;
  }
  [[nodiscard]] StereoCalibration calibration() const;
  [[nodiscard]] const std::array<PrintedTag, 2>& tags() const { return tags_; }

 private:
  [[nodiscard]] double wander(std::size_t axis, double t) const;
  [[nodiscard]] Transform<World, Marker> tool_at(std::size_t tool, double t) const;

  OtherKind kind_;
  std::array<RayGrid, 2> rays_;
  std::array<Transform<LeftCamera, Rig>, 2> camera_from_rig_;
  std::array<PrintedTag, 2> tags_;
  std::array<std::array<double, 3>, 20> phases_{};
};

}  // namespace orthonav::bench
