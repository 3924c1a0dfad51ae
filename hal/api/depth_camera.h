#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "base/image.h"
#include "base/result.h"
#include "base/time.h"
#include "base/transform.h"
#include "hal/api/frame_order.h"

namespace orthonav {

/// How a depth camera measures. One camera of a HoloLens is two streams.
enum class DepthStream {
  kAhat,       ///< HoloLens 2, near and fast; wraps: objects beyond about 1 m appear near
  kLongThrow,  ///< HoloLens 1 and 2: far and slow
  kShortThrow  ///< HoloLens 1, near and fast
};
/// "ahat", "long-throw" or "short-throw".
[[nodiscard]] const char* name_of(DepthStream stream);

/// A depth camera as the device describes it. No points are projected into it, so its table, unlike
/// a CameraModel's, may fold over outside a wide lens's image circle.
struct DepthCalibration {
  /// A unit vector in the camera's frame, as devices store it; z = 0: the pixel sees nothing.
  using Ray = std::array<float, 3>;
  /// The ray through a point of the unit plane; zeros where that is not finite.
  [[nodiscard]] static Ray ray_through(Vec2 unit_plane);

  DepthStream stream = DepthStream::kLongThrow;
  int width_px = 0;
  int height_px = 0;
  std::vector<Ray> rays;  ///< for each pixel's centre, row-major
  Transform<DepthSensor, Rig> sensor_from_rig;
  /// Metres after which the phase wraps, as the device states it: a point that much farther away
  /// measures the same. 0: not stated, as in recordings, or the camera does not wrap.
  double wraps_at_m = 0.0;

  /// Where a pixel's measurement lies; nothing without a measurement (0) or without a ray. The
  /// pixel must lie in the image.
  ///
  /// The measurement is the distance along the ray, not z. The tools of both recorders' makers read
  /// it that way (microsoft/HoloLens2ForCV StreamRecorderConverter/save_pclouds.py: unit rays times
  /// depth; microsoft/HoloLensForCV Samples/py/pcloud_compute.py and its issue 63: z = depth /
  /// sqrt(x^2 + y^2 + 1)), and jdibenes/hl2ss viewer/hl2ss_3dcv.py, for AHaT as for long throw.
  [[nodiscard]] std::optional<Point<DepthSensor>> point_at(int x_px, int y_px,
                                                           std::uint16_t range_mm) const;
};

/// One picture of a depth camera. The buffers are reused from frame to frame.
struct DepthFrame : FrameHeader {
  /// Distance along each pixel's ray in whole millimetres; 0: not measured, regardless of how the
  /// device marks that.
  DepthImage range_mm;
  /// How brightly each pixel returned the camera's own infrared light, in the device's unit; of the
  /// same size, or empty if the device does not report it.
  DepthImage brightness;

  void clear();
};

/// Pull interface of a depth camera. Contract, kept by the public call for every device: that of
/// StereoCamera, with both images of the calibration's size (brightness may be empty).
class DepthCamera {
 public:
  virtual ~DepthCamera() = default;
  /// The same at every call.
  [[nodiscard]] const DepthCalibration& calibration() const { return do_calibration(); }
  /// Fills `frame` with the next picture, never the same one twice, and never before the device's
  /// clock has reached its time. Does not block.
  Result<Next> next(DepthFrame& frame);

 private:
  [[nodiscard]] virtual const DepthCalibration& do_calibration() const = 0;
  virtual Result<Next> do_next(DepthFrame& frame) = 0;

  FrameOrder order_;
};

/// The list of depth cameras that a headset which owns them returns.
template <class Camera>
[[nodiscard]] std::vector<DepthCamera*> borrowed(
    const std::vector<std::unique_ptr<Camera>>& cameras) {
  std::vector<DepthCamera*> all;
  all.reserve(cameras.size());
  for (const auto& camera : cameras) {
    all.push_back(camera.get());
  }
  return all;
}

}  // namespace orthonav
